#include <algorithm>
#include <cmath>
#include <cstring>

#include "c_interface/c_support.hpp"
#include "scenes/mesh_of.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

template <typename Row, typename Same>
bool same_bytes(const Row& row, const Same& expected) {
  static_assert(sizeof row == sizeof expected);
  return std::memcmp(&row, &expected, sizeof row) == 0;
}

bool same_point(const double* point, const Eigen::Vector3d& expected) {
  return Eigen::Map<const Eigen::Vector3d>(point) == expected;
}

std::vector<Eigen::Vector3d> lifted(const models::MeshData& data, double height) {
  std::vector<Eigen::Vector3d> positions = data.positions;
  for (Eigen::Vector3d& at : positions) at.z() += height;
  return positions;
}

/// A tube over a box, at a height at which they pass through each other.
struct Surfaces {
  models::MeshData data_a = models::box({2, 2, 1});
  models::MeshData data_b = models::torus(12, 6, 1, 0.3);
  std::shared_ptr<const Mesh> mesh_a = scenes::mesh_of(data_a), mesh_b = scenes::mesh_of(data_b);
  Owned<graze_mesh> c_a = c_mesh(data_a), c_b = c_mesh(data_b);
  std::vector<Eigen::Vector3d> at_b = lifted(data_b, 0.7);
  graze_positions view_a = doubles(data_a.positions), view_b = doubles(at_b);
};

}  // namespace

TEST_CASE("c: two surfaces, and their contacts at other positions") {
  Surfaces s;
  const QuerySettings settings{.contact_distance = 0.25,
                               .detail = ContactDetail::nearest,
                               .a_is_solid = true,
                               .b_is_solid = true,
                               .max_contacts = 40,
                               .ways_out = true};
  graze_query_settings given;
  expect_ok(graze_query_settings_init(&given, sizeof given));
  given.contact_distance = 0.25;
  given.detail = GRAZE_DETAIL_NEAREST;
  given.a_is_solid = given.b_is_solid = given.ways_out = true;
  given.max_contacts = 40;
  graze_query* made = nullptr;
  expect_ok(graze_query_new(s.c_a.get(), s.c_b.get(), &given, &made));
  const Owned<graze_query> query(made);
  graze_query_result result{};
  expect_ok(graze_query_ask(query.get(), &s.view_a, &s.view_b, &result));
  const QueryResult expected = graze::query(*s.mesh_a, s.data_a.positions, *s.mesh_b, s.at_b, settings);
  CHECK(result.in_contact == expected.in_contact);
  CHECK(result.is_in_range == expected.is_in_range);
  CHECK(result.contacts_cut == expected.contacts_cut);
  CHECK(result.inside == static_cast<std::uint8_t>(expected.inside));
  CHECK(same_bytes(result.distance, expected.distance));
  CHECK(same_point(result.witness.point_a, expected.witness.point_a));
  CHECK(same_point(result.way_out.direction, expected.way_out.direction));
  CHECK(result.way_out.thickness > 0);
  REQUIRE(result.contact_count == expected.contacts.size());
  REQUIRE(result.contact_count > 3);

  const std::vector<Eigen::Vector3d> later = lifted(s.data_b, 0.73);
  const graze_positions later_view = doubles(later);
  std::vector<graze_contact_geometry> geometries(result.contact_count);
  expect_ok(graze_evaluate_contacts(s.c_a.get(), &s.view_a, s.c_b.get(), &later_view, result.contacts,
                                    result.contact_count, geometries.data()));
  std::vector<double> separations(result.contact_count);
  std::vector<double> pushes(3 * result.contact_count);
  expect_ok(
      graze_contact_separations(result.contacts, result.contact_count, separations.data(), pushes.data()));
  for (std::size_t i = 0; i < result.contact_count; ++i) {
    const Contact& contact = expected.contacts[i];
    const graze_contact& read = result.contacts[i];
    CHECK(read.kind == static_cast<std::uint8_t>(contact.kind));
    CHECK(read.feature_a.index == contact.feature_a.index);
    CHECK(read.feature_b.kind == static_cast<std::uint8_t>(contact.feature_b.kind));
    CHECK(same_point(read.point_b, contact.point_b));
    CHECK(separations[i] == contact.separation());
    CHECK(same_point(&pushes[3 * i], contact.push()));
    const ContactGeometry geometry = evaluate(*s.mesh_a, s.data_a.positions, *s.mesh_b, later, contact);
    CHECK(same_point(geometries[i].point_a, geometry.point_a));
    CHECK(same_point(geometries[i].push, geometry.push));
    CHECK(geometries[i].separation == geometry.separation);
    CHECK(geometries[i].is_interior == geometry.is_interior);
  }

  std::vector<graze_followed_contact> followed(result.contact_count);
  for (const bool of_b : {false, true}) {
    expect_ok(graze_follow_contacts(s.c_a.get(), &s.view_a, s.c_b.get(), &later_view, result.contacts,
                                    result.contact_count, of_b, followed.data()));
    for (std::size_t i = 0; i < result.contact_count; ++i) {
      const FollowedContact walked = (of_b ? follow_vertex_of_b : follow)(
          *s.mesh_a, s.data_a.positions, *s.mesh_b, later, expected.contacts[i]);
      CHECK(followed[i].is_known == walked.is_known);
      CHECK(followed[i].steps == walked.steps);
      CHECK(followed[i].feature_a.index == walked.feature_a.index);
      CHECK(followed[i].feature_b.index == walked.feature_b.index);
      CHECK(followed[i].geometry.separation == walked.geometry.separation);
    }
  }

  const graze_contact& first = result.contacts[0];
  graze_contact_geometry plain{};
  expect_ok(graze_evaluate(s.c_a.get(), &s.view_a, first.feature_a, s.c_b.get(), &later_view, first.feature_b,
                           &plain));
  const Contact& contact = expected.contacts[0];
  const ContactGeometry geometry =
      evaluate(*s.mesh_a, s.data_a.positions, contact.feature_a, *s.mesh_b, later, contact.feature_b);
  CHECK(plain.distance == geometry.distance);
  CHECK(same_point(plain.normal, geometry.normal));
  graze_weights shares{};
  expect_ok(graze_surface_weights(s.c_b.get(), &s.view_b, first.feature_b, first.point_b, &shares));
  const SurfaceWeights carried = weights(*s.mesh_b, s.at_b, contact.feature_b, contact.point_b);
  CHECK(shares.count == carried.count);
  CHECK(shares.vertex[0] == carried.vertex[0]);
  CHECK(shares.weight[0] == carried.weight[0]);
  bool is_in_cone = false;
  expect_ok(graze_in_normal_cone(s.c_a.get(), &s.view_a, first.feature_a, &pushes[0], &is_in_cone));
  CHECK(is_in_cone == in_normal_cone(*s.mesh_a, s.data_a.positions, contact.feature_a, contact.push()));

  // Bad positions are refused, and so are features that the mesh does not have.
  graze_positions short_view = s.view_b;
  short_view.count = 3;
  expect_fails(graze_query_ask(query.get(), &s.view_a, &short_view, &result), GRAZE_REFUSED, "positions");
  expect_fails(graze_evaluate(s.c_a.get(), &s.view_a, graze_feature{GRAZE_VERTEX, 900}, s.c_b.get(),
                              &later_view, first.feature_b, &plain),
               GRAZE_REFUSED, "900");
}

TEST_CASE("c: questions about a report") {
  Surfaces s;
  SceneSettings settings;
  settings.threads = 1;
  Scene cpp(settings);
  const auto c = c_scene(settings);
  const ObjectSettings asked{.layer = 2, .solid = true, .queries = true};
  const graze_object_settings given = c_settings(asked);
  graze_id c_id{};
  const ObjectId id = cpp.add(s.mesh_a, asked);
  expect_ok(graze_scene_add(c.get(), s.c_a.get(), &given, &c_id));
  graze_report* report = nullptr;
  expect_ok(graze_scene_step(c.get(), 0, &report));
  const Owned<graze_report> owned(report);
  SceneQuery expected(cpp.step());
  graze_scene_query* made = nullptr;
  expect_ok(graze_scene_query_new(report, &made));
  const Owned<graze_scene_query> query(made);

  const double from[3] = {0.25, 0.5, 4};
  const double down[3] = {0, 0, -1};
  std::size_t count = 9;
  graze_ray_hit hits[4] = {};
  expect_ok(graze_scene_query_cast_ray(query.get(), from, down, INFINITY, nullptr, hits, 4, &count));
  RayHit rays[4];
  REQUIRE(count == expected.cast_ray({0.25, 0.5, 4}, {0, 0, -1}, INFINITY, rays));
  REQUIRE(count == 2);
  CHECK(hits[1].t == rays[1].t);
  CHECK(hits[1].object.index == id.index);
  CHECK(hits[1].face == rays[1].face);
  CHECK(same_point(hits[1].normal, rays[1].normal));

  graze_sphere_hit sphere{};
  const double to[3] = {0.25, 0.5, 0};
  expect_ok(graze_scene_query_cast_sphere(query.get(), from, to, 0.5, nullptr, &sphere, 1, &count));
  REQUIRE(count == 1);
  CHECK(sphere.t == expected.cast_sphere({0.25, 0.5, 4}, {0.25, 0.5, 0}, 0.5)->t);

  graze_closest_point closest{};
  expect_ok(graze_scene_query_closest_points(query.get(), from, INFINITY, nullptr, &closest, 1, &count));
  REQUIRE(count == 1);
  CHECK(closest.distance == expected.closest_point({0.25, 0.5, 4})->distance);
  CHECK(closest.side == GRAZE_SIDE_FRONT);

  const graze_query_filter other{~0U, 1, {0, 0}};
  expect_ok(graze_scene_query_cast_ray(query.get(), from, down, INFINITY, &other, hits, 4, &count));
  CHECK(count == 0);
  const graze_query_filter ignored{~0U, ~0U, c_id};
  expect_ok(graze_scene_query_closest_points(query.get(), from, INFINITY, &ignored, &closest, 1, &count));
  CHECK(count == 0);

  graze_probe* probe_made = nullptr;
  expect_ok(graze_probe_new(s.c_b.get(), true, &probe_made));
  const Owned<graze_probe> probe(probe_made);
  bool is_free = true;
  graze_id blocking[2] = {};
  expect_ok(graze_probe_set_positions(probe.get(), &s.view_b));
  expect_ok(graze_scene_query_is_free(query.get(), probe.get(), 0, nullptr, &is_free));
  CHECK_FALSE(is_free);
  expect_ok(graze_scene_query_blocking(query.get(), probe.get(), 0, nullptr, blocking, 2, &count));
  REQUIRE(count == 1);
  CHECK(blocking[0].index == id.index);
  const double away[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5};
  expect_ok(graze_probe_set_pose(probe.get(), away));
  expect_ok(graze_scene_query_is_free(query.get(), probe.get(), 0, nullptr, &is_free));
  CHECK(is_free);
  const double mirrored[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5};
  expect_fails(graze_probe_set_pose(probe.get(), mirrored), GRAZE_REFUSED, "reflection");

  const double low[3] = {0.9, 0.9, 0.4};
  const double high[3] = {2, 2, 2};
  expect_ok(graze_scene_query_objects_in_box(query.get(), low, high, nullptr, blocking, 2, &count));
  CHECK(count == expected.objects_in_box({0.9, 0.9, 0.4}, {2, 2, 2}, {}));
  CHECK(count == 1);
  expect_fails(graze_scene_query_objects_in_box(query.get(), high, low, nullptr, blocking, 2, &count),
               GRAZE_REFUSED, "empty");

  // Another report, none, and a copy, which keeps no surfaces for questions.
  graze_report* of_query = nullptr;
  expect_ok(graze_scene_query_report(query.get(), &of_query));
  CHECK(graze_report_pairs(of_query, nullptr) == graze_report_pairs(report, nullptr));
  graze_report* copy = nullptr;
  expect_ok(graze_report_copy(report, &copy));
  const Owned<graze_report> owned_copy(copy);
  expect_fails(graze_scene_query_set_report(query.get(), copy), GRAZE_BAD_ARGUMENT, "copy");
  expect_ok(graze_scene_query_set_report(query.get(), nullptr));
  expect_ok(graze_scene_query_cast_ray(query.get(), from, down, INFINITY, nullptr, hits, 4, &count));
  CHECK(count == 0);
  expect_ok(graze_scene_query_report(query.get(), &of_query));
  CHECK(of_query == nullptr);
}

TEST_CASE("c: patches of a report") {
  Surfaces s;
  SceneSettings settings;
  settings.threads = 1;
  settings.contact_distance = 0.125;
  Scene cpp(settings);
  const auto c = c_scene(settings);
  const ObjectSettings of_tool{.motion = Motion::rigid, .patch_radius = 2, .patch_faces = 99};
  const graze_object_settings given_tool = c_settings(of_tool);
  const ObjectSettings of_other;
  const graze_object_settings given_other = c_settings(of_other);
  graze_id c_other{};
  graze_id c_tool{};
  const ObjectId other = cpp.add(s.mesh_a, of_other);
  const ObjectId tool = cpp.add(s.mesh_b, of_tool);
  expect_ok(graze_scene_add(c.get(), s.c_a.get(), &given_other, &c_other));
  expect_ok(graze_scene_add(c.get(), s.c_b.get(), &given_tool, &c_tool));
  graze_report* report = nullptr;
  expect_ok(graze_scene_step(c.get(), 0, &report));
  const Owned<graze_report> owned(report);
  const ReportHandle expected = cpp.step();
  const Patch patch = expected->patch(tool);
  REQUIRE(patch);

  graze_patch found{};
  expect_ok(graze_report_patch(report, c_other, &found));
  CHECK_FALSE(found.exists);
  expect_ok(graze_report_patch(report, c_tool, &found));
  CHECK(found.exists);
  CHECK(found.is_cut == patch.is_cut());
  CHECK(found.radius == patch.radius());
  CHECK(found.face_count == patch.face_count());
  REQUIRE(found.object_count == 1);
  CHECK(found.objects[0].index == other.index);
  const uint32_t* faces = nullptr;
  std::size_t count = 0;
  expect_ok(graze_patch_faces(report, c_tool, c_other, &faces, &count));
  REQUIRE(count == patch.faces(other).size());
  CHECK(std::equal(faces, faces + count, patch.faces(other).begin()));
  graze_positions positions{};
  expect_ok(graze_patch_positions(report, c_tool, c_other, &positions));
  CHECK(positions.count == s.mesh_a->vertex_count());

  graze_patch_room* made = nullptr;
  expect_ok(graze_patch_room_new(&made));
  const Owned<graze_patch_room> room(made);
  graze_patch_answer answer{};
  const double rows[12] = {1, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0.0625};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.25, 0, 0.0625);
  PatchRoom truth;
  const auto check_room = [&](const PatchAnswer& of_cpp) {
    CHECK(answer.complete == of_cpp.complete);
    CHECK(answer.threshold == of_cpp.threshold);
    CHECK(answer.validity == of_cpp.validity);
    const graze_patch_pair* const pairs = graze_patch_room_pairs(room.get(), &count);
    REQUIRE(count == truth.pairs().size());
    REQUIRE(count == 1);
    CHECK(pairs[0].b.index == tool.index);
    CHECK(pairs[0].contact_count == truth.pairs()[0].contact_count);
    const graze_contact* const contacts = graze_patch_room_contacts(room.get(), &count);
    REQUIRE(count == truth.contacts().size());
    CHECK(contacts[0].distance == truth.contacts()[0].distance);
    CHECK(contacts[0].feature_b.index == truth.contacts()[0].feature_b.index);
  };
  expect_ok(graze_patch_contacts_at_pose(report, c_tool, rows, 0.5, room.get(), &answer));
  check_room(patch.contacts(pose, 0.5, truth));
  expect_ok(graze_patch_contacts_at_positions(report, c_tool, &s.view_b, 0.25, room.get(), &answer));
  check_room(patch.contacts(s.at_b, 0.25, truth));
  double validity = 0;
  const double threshold = 0.5;
  expect_ok(graze_patch_validity_at_pose(report, c_tool, rows, nullptr, &validity));
  CHECK(validity == patch.validity(pose));
  expect_ok(graze_patch_validity_at_positions(report, c_tool, &s.view_b, &threshold, &validity));
  CHECK(validity == patch.validity(s.at_b, 0.5));

  const double mirrored[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  expect_fails(graze_patch_contacts_at_pose(report, c_tool, mirrored, 0.5, room.get(), &answer),
               GRAZE_REFUSED, "reflection");
  expect_fails(graze_patch_contacts_at_pose(report, c_other, rows, 0.5, room.get(), &answer),
               GRAZE_BAD_ARGUMENT, "patch_radius");
  expect_fails(graze_patch_contacts_at_pose(report, c_tool, rows, 0.5, nullptr, &answer), GRAZE_BAD_ARGUMENT,
               "room");
  CHECK(graze_patch_room_contacts(nullptr, &count) == nullptr);
}

}  // namespace graze::tests
