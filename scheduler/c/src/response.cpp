#include <graze/contact_geometry.hpp>
#include <graze/contact_walk.hpp>

#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "positions.hpp"
#include "settings.hpp"

// Contacts at other positions, and two surfaces without a scene.

using graze::Feature;
using graze::c::array;
using graze::c::cpp_rows;
using graze::c::given;
using graze::c::guarded;
using graze::c::mesh_of;
using graze::c::same;
using graze::c::view_of;

namespace {

/// Two surfaces at positions of the caller's.
struct Surfaces {
  Surfaces(const graze_mesh* of_a, const graze_positions* at_a, const graze_mesh* of_b,
           const graze_positions* at_b)
      : mesh_a(mesh_of(of_a, "mesh_a")),
        mesh_b(mesh_of(of_b, "mesh_b")),
        positions_a(view_of(at_a, "positions_a")),
        positions_b(view_of(at_b, "positions_b")) {}

  /// Fills the caller's room with the answer for each contact.
  template <typename Row, typename Answer>
  void for_each(std::span<const graze_contact> contacts, std::span<Row> room, const Answer& answer) const {
    const graze::Contact* const read = cpp_rows(contacts.data());
    for (size_t i = 0; i < room.size(); ++i) room[i] = same<Row>(answer(read[i]));
  }

  const graze::Mesh& mesh_a;
  const graze::Mesh& mesh_b;
  graze::PositionView positions_a;
  graze::PositionView positions_b;
};

void copy_point(const Eigen::Vector3d& point, double* room) {
  for (int axis = 0; axis < 3; ++axis) room[axis] = point[axis];
}

static_assert(graze::c::has_members<
              graze::QueryResult, &graze::QueryResult::in_contact, &graze::QueryResult::is_in_range,
              &graze::QueryResult::contacts_cut, &graze::QueryResult::inside, &graze::QueryResult::distance,
              &graze::QueryResult::witness, &graze::QueryResult::way_out, &graze::QueryResult::contacts>());
graze_query_result described(const graze::QueryResult& result) {
  graze_query_result made{};
  made.in_contact = result.in_contact;
  made.is_in_range = result.is_in_range;
  made.contacts_cut = result.contacts_cut;
  made.inside = static_cast<uint8_t>(result.inside);
  made.distance = same<graze_bounds>(result.distance);
  made.witness = same<graze_witness>(result.witness);
  made.way_out = same<graze_way_out>(result.way_out);
  made.contacts = graze::c::c_rows<graze_contact>(std::span(result.contacts), &made.contact_count);
  return made;
}

}  // namespace

extern "C" {

graze_status graze_contact_separations(const graze_contact* contacts, size_t count, double* separations,
                                       double* pushes) {
  return guarded([&] {
    const graze::Contact* const read = cpp_rows(array(contacts, count, "contacts").data());
    for (size_t i = 0; i < count; ++i) {
      if (separations != nullptr) separations[i] = read[i].separation();
      if (pushes != nullptr) copy_point(read[i].push(), pushes + 3 * i);
    }
  });
}

graze_status graze_evaluate(const graze_mesh* mesh_a, const graze_positions* positions_a,
                            graze_feature feature_a, const graze_mesh* mesh_b,
                            const graze_positions* positions_b, graze_feature feature_b,
                            graze_contact_geometry* geometry) {
  return guarded([&] {
    given(geometry, "geometry") = same<graze_contact_geometry>(graze::evaluate(
        mesh_of(mesh_a, "mesh_a"), view_of(positions_a, "positions_a"), same<Feature>(feature_a),
        mesh_of(mesh_b, "mesh_b"), view_of(positions_b, "positions_b"), same<Feature>(feature_b)));
  });
}

graze_status graze_evaluate_contacts(const graze_mesh* mesh_a, const graze_positions* positions_a,
                                     const graze_mesh* mesh_b, const graze_positions* positions_b,
                                     const graze_contact* contacts, size_t count,
                                     graze_contact_geometry* geometries) {
  return guarded([&] {
    const Surfaces at(mesh_a, positions_a, mesh_b, positions_b);
    at.for_each(array(contacts, count, "contacts"), array(geometries, count, "geometries"),
                [&](const graze::Contact& contact) {
                  return graze::evaluate(at.mesh_a, at.positions_a, at.mesh_b, at.positions_b, contact);
                });
  });
}

graze_status graze_follow_contacts(const graze_mesh* mesh_a, const graze_positions* positions_a,
                                   const graze_mesh* mesh_b, const graze_positions* positions_b,
                                   const graze_contact* contacts, size_t count, bool vertices_of_b,
                                   graze_followed_contact* followed) {
  return guarded([&] {
    const Surfaces at(mesh_a, positions_a, mesh_b, positions_b);
    const auto follow = vertices_of_b ? &graze::follow_vertex_of_b : &graze::follow;
    at.for_each(array(contacts, count, "contacts"), array(followed, count, "followed"),
                [&](const graze::Contact& contact) {
                  return follow(at.mesh_a, at.positions_a, at.mesh_b, at.positions_b, contact);
                });
  });
}

graze_status graze_surface_weights(const graze_mesh* mesh, const graze_positions* positions,
                                   graze_feature feature, const double point[3], graze_weights* weights) {
  return guarded([&] {
    given(weights, "weights") =
        same<graze_weights>(graze::weights(mesh_of(mesh, "mesh"), view_of(positions, "positions"),
                                           same<Feature>(feature), graze::c::point_of(point, "point")));
  });
}

graze_status graze_in_normal_cone(const graze_mesh* mesh, const graze_positions* positions,
                                  graze_feature feature, const double direction[3], bool* is_in_cone) {
  return guarded([&] {
    given(is_in_cone, "is_in_cone") =
        graze::in_normal_cone(mesh_of(mesh, "mesh"), view_of(positions, "positions"), same<Feature>(feature),
                              graze::c::point_of(direction, "direction"));
  });
}

graze_status graze_query_new(const graze_mesh* mesh_a, const graze_mesh* mesh_b,
                             const graze_query_settings* settings, graze_query** query) {
  return guarded([&] {
    auto& room = given(query, "query");
    room = new graze_query{
        graze::RepeatedQuery(mesh_of(mesh_a, "mesh_a"), mesh_of(mesh_b, "mesh_b"),
                             graze::c::read_settings<graze::QuerySettings>(settings, "settings"))};
  });
}

graze_status graze_query_ask(graze_query* query, const graze_positions* positions_a,
                             const graze_positions* positions_b, graze_query_result* result) {
  return guarded([&] {
    auto& room = given(result, "result");
    room =
        described(given(query, "query")
                      .query.ask(view_of(positions_a, "positions_a"), view_of(positions_b, "positions_b")));
  });
}

void graze_query_release(graze_query* query) {
  delete query;
}

}  // extern "C"
