#include <algorithm>
#include <graze/instruction_set.hpp>
#include <graze/recorder.hpp>
#include <graze/version.hpp>

#include "c_interface/c_support.hpp"
#include "scenes/mesh_of.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

template <typename Enum, typename Name>
void check_names(const Name& name) {
  for (const Enum value : enumerators<Enum>) CHECK(name(static_cast<std::uint8_t>(value)) == name_of(value));
  CHECK(name(static_cast<std::uint8_t>(enumerators<Enum>.size())) == nullptr);
}

std::vector<std::uint32_t> list_of(const graze_mesh* mesh, std::uint8_t list, std::uint32_t index) {
  const std::uint32_t* first = nullptr;
  std::size_t count = 0;
  expect_ok(graze_mesh_list(mesh, list, index, &first, &count));
  return {first, first + count};
}

bool equal(const std::vector<std::uint32_t>& list, std::span<const std::uint32_t> expected) {
  return std::ranges::equal(list, expected);
}

}  // namespace

TEST_CASE("c: a mesh is the one of C++") {
  // Triangles and quads, an open border, a vertex that nothing uses, and a face without area.
  models::MeshData data = models::sheet(3, 2, 1, 1);
  data.add_face({0, 1, 1});
  data.add_face({0, 1, 4});
  data.positions.emplace_back(9, 9, 9);
  const auto expected = scenes::mesh_of(data);
  const auto mesh = c_mesh(data);
  REQUIRE(graze_mesh_vertex_count(mesh.get()) == expected->vertex_count());
  REQUIRE(graze_mesh_face_count(mesh.get()) == expected->face_count());
  REQUIRE(graze_mesh_edge_count(mesh.get()) == expected->edge_count());
  REQUIRE(graze_mesh_corner_count(mesh.get()) == data.corners.size());
  CHECK(std::equal(graze_mesh_rest(mesh.get()), graze_mesh_rest(mesh.get()) + 3 * data.positions.size(),
                   data.positions[0].data()));

  std::vector<std::uint32_t> corners(data.corners.size());
  std::vector<std::uint32_t> counts(data.corner_counts.size());
  std::vector<std::uint32_t> edges(data.corners.size());
  std::vector<std::uint32_t> ends(std::size_t{2} * expected->edge_count());
  expect_ok(graze_mesh_faces(mesh.get(), corners.data(), counts.data()));
  expect_ok(graze_mesh_face_edges(mesh.get(), edges.data()));
  expect_ok(graze_mesh_edges(mesh.get(), ends.data()));
  CHECK(corners == data.corners);
  CHECK(counts == data.corner_counts);
  std::size_t corner = 0;
  for (std::uint32_t face = 0; face < expected->face_count(); ++face)
    for (const std::uint32_t edge : expected->face_edges(face)) CHECK(edges[corner++] == edge);
  for (std::uint32_t edge = 0; edge < expected->edge_count(); ++edge) {
    CHECK(ends[2 * edge] == expected->edge(edge)[0]);
    CHECK(ends[2 * edge + 1] == expected->edge(edge)[1]);
    CHECK(equal(list_of(mesh.get(), GRAZE_EDGE_FACES, edge), expected->edge_faces(edge)));
  }
  for (std::uint32_t vertex = 0; vertex < expected->vertex_count(); ++vertex) {
    CHECK(equal(list_of(mesh.get(), GRAZE_VERTEX_NEIGHBOURS, vertex), expected->vertex_neighbours(vertex)));
    CHECK(equal(list_of(mesh.get(), GRAZE_VERTEX_FACES, vertex), expected->vertex_faces(vertex)));
    CHECK(graze_mesh_is_used(mesh.get(), vertex) == expected->is_used(vertex));
  }
  CHECK_FALSE(graze_mesh_is_used(mesh.get(), expected->vertex_count()));
  CHECK_FALSE(graze_mesh_uses_all_vertices(mesh.get()));
  CHECK(graze_mesh_byte_count(mesh.get()) > 0);
  const std::uint32_t* first = nullptr;
  std::size_t count = 0;
  expect_fails(graze_mesh_list(mesh.get(), GRAZE_VERTEX_FACES, 99, &first, &count), GRAZE_BAD_ARGUMENT, "99");
  expect_fails(graze_mesh_list(mesh.get(), 7, 0, &first, &count), GRAZE_BAD_ARGUMENT, "list");

  const MeshOddities oddities = find_oddities(*expected);
  const std::vector<std::uint32_t>* lists[] = {&oddities.degenerate_faces,   &oddities.duplicate_faces,
                                               &oddities.isolated_vertices,  &oddities.duplicate_vertices,
                                               &oddities.non_manifold_edges, &oddities.border_edges,
                                               &oddities.flipped_edges};
  for (std::uint8_t list = 0; list < std::size(lists); ++list) {
    std::vector<std::uint32_t> found(lists[list]->size());
    expect_ok(graze_mesh_oddities(mesh.get(), list, found.data(), found.size(), &count));
    CHECK(count == found.size());
    CHECK(found == *lists[list]);
  }
  CHECK_FALSE(oddities.degenerate_faces.empty());
  CHECK_FALSE(oddities.border_edges.empty());
  // Less room than there is: the count says so, and nothing beyond it is written.
  std::uint32_t one[2] = {7, 7};
  expect_ok(graze_mesh_oddities(mesh.get(), GRAZE_BORDER_EDGES, one, 1, &count));
  CHECK(count == oddities.border_edges.size());
  CHECK(one[0] == oddities.border_edges[0]);
  CHECK(one[1] == 7);
}

TEST_CASE("c: meshes from triangles and quads, shared and welded") {
  const models::MeshData triangles = models::box({1, 2, 3}, models::Faces::triangles);
  const models::MeshData quads = models::box({1, 2, 3});
  graze_mesh* mesh = nullptr;
  graze_positions rest = doubles(triangles.positions);
  expect_ok(
      graze_mesh_from_triangles(&rest, triangles.corners.data(), triangles.corner_counts.size(), &mesh));
  CHECK(graze_mesh_corner_count(mesh) == 36);
  graze_mesh_release(mesh);
  rest = doubles(quads.positions);
  expect_ok(graze_mesh_from_quads(&rest, quads.corners.data(), quads.corner_counts.size(), &mesh));
  CHECK(graze_mesh_corner_count(mesh) == 24);
  graze_mesh* shared = nullptr;
  expect_ok(graze_mesh_share(mesh, &shared));
  CHECK(graze_mesh_rest(shared) == graze_mesh_rest(mesh));
  graze_mesh_release(mesh);
  CHECK(graze_mesh_vertex_count(shared) == 8);
  graze_mesh_release(shared);

  // Two triangles that share an edge by place alone, given as floats with a gap.
  const float loose[] = {0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9, 1, 0, 0, 9, 1, 1, 0, 9, 0, 1, 0, 9};
  const std::uint32_t corners[] = {0, 1, 2, 3, 4, 5};
  rest = {static_cast<const float*>(loose), 6, 4 * sizeof(float), 0, false};
  expect_ok(graze_mesh_from_triangles(&rest, corners, 2, &mesh));
  graze_mesh* welded = nullptr;
  std::uint32_t new_vertex[6];
  std::uint32_t new_face[2];
  expect_ok(graze_mesh_weld(mesh, 0, new_vertex, new_face, &welded));
  CHECK(graze_mesh_vertex_count(welded) == 4);
  CHECK(new_vertex[3] == new_vertex[1]);
  CHECK(new_vertex[5] == new_vertex[2]);
  CHECK(new_face[1] == 1);
  graze_mesh_release(welded);
  graze_mesh_release(mesh);
}

TEST_CASE("c: names, version and instruction set") {
  check_names<FeatureKind>(graze_feature_kind_name);
  check_names<ContactKind>(graze_contact_kind_name);
  check_names<Side>(graze_side_name);
  check_names<Inside>(graze_inside_name);
  check_names<ImpactStatus>(graze_impact_status_name);
  check_names<PairPhase>(graze_pair_phase_name);
  check_names<Motion>(graze_motion_name);
  check_names<BindPolicy>(graze_bind_policy_name);
  check_names<ArenaPolicy>(graze_arena_policy_name);
  check_names<AccuracyMode>(graze_accuracy_mode_name);
  check_names<ContactDetail>(graze_contact_detail_name);
  check_names<DiagnosticKind>(graze_diagnostic_kind_name);
  CHECK(std::string(graze_when_behind_name(GRAZE_WAIT)) == name_of(WhenBehind::wait));
  CHECK(graze_when_behind_name(2) == nullptr);
  // The constants stand in the order of the enumerators, so their last ones show that none is missing.
  CHECK(std::string(graze_diagnostic_kind_name(GRAZE_DIAGNOSTIC_OUT_OF_MEMORY)) == "out_of_memory");
  CHECK(std::string(graze_contact_detail_name(GRAZE_DETAIL_NEAREST)) == "nearest");
  CHECK(std::string(graze_contact_kind_name(GRAZE_FF)) == "FF");
  CHECK(std::string(graze_pair_phase_name(GRAZE_ENDED)) == "ended");
  CHECK(std::string(graze_inside_name(GRAZE_CROSSING)) == "crossing");
  CHECK(std::string(graze_impact_status_name(GRAZE_AT_START)) == "at_start");
  std::int32_t version[3];
  graze_library_version(version);
  CHECK(std::ranges::equal(version, library_version()));
  CHECK(std::array{version[0], version[1], version[2]} ==
        std::array{GRAZE_VERSION_MAJOR, GRAZE_VERSION_MINOR, GRAZE_VERSION_PATCH});
  const std::string before = graze_instruction_set();
  CHECK(before == to_string(instruction_set()));
  expect_ok(graze_use_instruction_set("scalar"));
  CHECK(std::string(graze_instruction_set()) == "scalar");
  expect_ok(graze_use_instruction_set(before.c_str()));
  CHECK(graze_max_threads() == max_threads());
}

}  // namespace graze::tests
