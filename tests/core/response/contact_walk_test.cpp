// This test follows contacts of random bodies under small motions. A followed vertex is compared with the
// closest point of the whole surface by brute force, and with the winding number. Edges are compared with the
// contacts of an exact query at the same positions.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <graze/contact_walk.hpp>
#include <iostream>
#include <string>
#include <string_view>

#include "core/placed_shape.hpp"
#include "core/response/plain_oracle.hpp"
#include "core/shapes.hpp"
#include "models/models.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"
#include "support/random/random_solids.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

FollowedContact followed(const Placed& a, const Placed& b, const Contact& contact, bool keeps_b = false) {
  return (keeps_b ? follow_vertex_of_b : follow)(*a.mesh, a.shape.positions, *b.mesh, b.shape.positions,
                                                 contact);
}

/// A shape turned about a point of its own by up to `size` radians, moved by up to `size`, and deformed by
/// waves of a tenth of that.
Shape shaken(const Shape& shape, const Vector3d& about, double size, std::uint64_t seed) {
  Random random(seed);
  const Vector3d axis = random.vector(-1, 1);
  const double angle = random.between(-size, size);
  const Vector3d offset = random.vector(-size, size);
  const Eigen::AngleAxisd turn(angle, axis.normalized());
  Shape result = wobbled(shape, 0.1 * size, seed + 1);
  for (Vector3d& position : result.positions) position = about + offset + turn * (position - about);
  return result;
}

struct Bodies {
  std::string name;
  Shape a, b;
  double reach = 0;  ///< contacts are those below this distance
  double motion = 0;
};

/// Counts the answers for followed contacts.
struct Counts {
  std::size_t known = 0, unknown = 0, moved = 0, passed = 0, most_steps = 0;

  void add(const FollowedContact& found, const Contact& contact) {
    ++(found.is_known ? known : unknown);
    if (!found.is_known) return;
    moved += found.steps > 0 ? 1U : 0U;
    passed += (found.geometry.separation < 0) != (contact.separation() < 0) ? 1U : 0U;
    most_steps = std::max<std::size_t>(most_steps, found.steps);
  }
};

std::ostream& operator<<(std::ostream& out, const Counts& counts) {
  return out << counts.known << " known, " << counts.moved << " of them on other features and "
             << counts.passed << " through the surface, at most " << counts.most_steps << " steps, "
             << counts.unknown << " not known";
}

bool has_vertex(const Contact& contact) {
  return contact.feature_a.kind == FeatureKind::vertex || contact.feature_b.kind == FeatureKind::vertex;
}

/// The closest point of the whole surface to the vertex that a contact keeps, with a sign.
double true_separation(const Placed& a, const Placed& b, const FollowedContact& found, bool is_of_a) {
  const Shape& surface = is_of_a ? b.shape : a.shape;
  const Vector3d point =
      is_of_a ? a.shape.positions[found.feature_a.index] : b.shape.positions[found.feature_b.index];
  const double distance = distance_from_surface(point, surface);
  return winding_about(point, surface) > 0.5 ? -distance : distance;
}

void check_geometry(const Placed& a, const Placed& b, const FollowedContact& found) {
  const ContactGeometry& now = found.geometry;
  const ContactGeometry of_features = evaluate(a, found.feature_a, b, found.feature_b);
  CHECK(now.is_interior);
  CHECK(of_features.is_interior);
  CHECK((now.point_a - of_features.point_a).norm() < 1e-9);
  CHECK((now.point_b - of_features.point_b).norm() < 1e-9);
  CHECK(std::abs(now.distance - std::abs(now.separation)) == 0);
  CHECK((now.point_b - now.point_a - now.separation * now.push).norm() < 1e-12);
  CHECK(std::abs(now.push.norm() - 1) < 1e-12);
}

void check_vertices(const Bodies& bodies, std::uint64_t poses, Counts& counts) {
  const Placed a(bodies.a);
  const Placed b(bodies.b);
  const auto contacts = contacts_of(a, b, ContactDetail::nearest, bodies.reach, {true, true}).contacts;
  CAPTURE(bodies.name, contacts_of(a, b, ContactDetail::closest, 10).distance.lower);
  REQUIRE(!contacts.empty());
  for (std::uint64_t pose = 0; pose < poses; ++pose) {
    CAPTURE(pose);
    const Vector3d about = contacts[0].point_a;
    const Placed now_a(shaken(bodies.a, about, bodies.motion, 2 * pose));
    const Placed now_b(shaken(bodies.b, about, bodies.motion, 2 * pose + 1));
    for (const Contact& contact : contacts) {
      if (!has_vertex(contact)) continue;
      for (const bool keeps_b : {false, true}) {
        const FollowedContact found = followed(now_a, now_b, contact, keeps_b);
        counts.add(found, contact);
        if (!found.is_known) continue;
        CAPTURE(static_cast<int>(contact.kind), contact.feature_a.index, contact.feature_b.index, keeps_b,
                static_cast<int>(contact.side_a), static_cast<int>(contact.side_b), found.steps,
                found.geometry.separation, contact.distance);
        const bool is_of_a = contact.feature_a.kind == FeatureKind::vertex &&
                             (!keeps_b || contact.feature_b.kind != FeatureKind::vertex);
        CHECK((is_of_a ? found.feature_a : found.feature_b) ==
              (is_of_a ? contact.feature_a : contact.feature_b));
        CHECK(std::abs(found.geometry.separation - true_separation(now_a, now_b, found, is_of_a)) < 1e-12);
        check_geometry(now_a, now_b, found);
      }
    }
  }
}

/// Two bodies along an axis, whose surfaces are as far apart as `gap` says, or overlap by about that much.
Bodies near_bodies(const std::string& name, const Shape& a, const Shape& b, int axis, double gap,
                   double motion) {
  const Shape apart = placed_beside(b, a, axis, 0);
  const Contact closest = contacts_of(Placed(a), Placed(apart), ContactDetail::closest, 10).contacts.at(0);
  return {name, a, mapped(apart, 1, (gap - closest.distance) * closest.normal), 0.08, motion};
}

/// Two convex bodies of which one is turned, with a gap between their boxes that may be negative.
Bodies convex_bodies(const std::string& name, const Shape& a, const Shape& b, double gap, double motion,
                     std::uint64_t seed) {
  const Shape body = turned(a, seed);
  return near_bodies(name, body, turned(b, seed + 1), 0, gap, motion);
}

std::vector<Bodies> all_convex_bodies(std::uint64_t seed) {
  using models::Faces;
  const Shape ball = shape_of(models::sphere(24, 16));
  const Shape ball_of_quads = shape_of(models::sphere(16, 10, Faces::quads));
  const Shape brick = shape_of(models::box({1, 0.7, 0.4}));
  const Shape plate = shape_of(models::box({1.2, 0.8, 0.3}, Faces::triangles));
  std::vector<Bodies> all;
  for (const double gap : {0.01, -0.02}) {
    all.push_back(convex_bodies("balls", ball, ball_of_quads, gap, 0.03, seed));
    all.push_back(convex_bodies("ball and brick", ball, brick, gap, 0.03, seed + 2));
    all.push_back(convex_bodies("bricks", brick, plate, gap, 0.02, seed + 4));
  }
  return all;
}

/// Many contacts went over to other features, some passed through the surface, and few are not known.
void check_counts(std::string_view of, const Counts& counts) {
  std::cout << of << ": " << counts << "\n";
  CHECK(counts.moved > counts.known / 10);
  CHECK(counts.passed > 0);
  CHECK(counts.unknown * 100 < counts.known);
}

}  // namespace

TEST_CASE("follow: at the positions of its report a contact is what it was") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < repeats(600); ++seed) {
    CAPTURE(seed);
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Placed a(scene.a);
    const Placed b(scene.b);
    for (const Contact& contact : contacts_of(a, b, ContactDetail::nearest).contacts) {
      if (!has_vertex(contact) || contact.distance < 1e-6) continue;
      CAPTURE(static_cast<int>(contact.kind), contact.feature_a.index, contact.feature_b.index);
      // One of two vertices may have a nearer point.
      FollowedContact found = followed(a, b, contact);
      if (!found.is_known || found.geometry.distance < contact.distance - 1e-9)
        found = followed(a, b, contact, true);
      CHECK(found.is_known);
      CHECK(std::abs(found.geometry.distance - contact.distance) < 1e-9);
      ++compared;
      // Two vertices may disagree about their sides. Then that of the one that is kept counts.
      if (contact.kind == ContactKind::VV && contact.side_a != contact.side_b) continue;
      CHECK(std::abs(found.geometry.separation - contact.separation()) < 1e-9);
      CHECK((found.geometry.push - contact.push()).norm() < 1e-6);
      CHECK(found.geometry.side_a == contact.side_a);
      CHECK(found.geometry.side_b == contact.side_b);
    }
  }
  std::cout << "compared " << compared << " contacts of vertices\n";
  CHECK(compared > 1000 * repeats(100) / 100);
}

TEST_CASE("follow: a vertex of a convex body has the closest point of the whole surface where it is known") {
  Counts counts;
  for (std::uint64_t seed = 0; seed < repeats(20); ++seed)
    for (const Bodies& bodies : all_convex_bodies(100 * seed)) check_vertices(bodies, 6, counts);
  check_counts("convex bodies", counts);
}

TEST_CASE("follow: a vertex near a gently curved surface has its closest point where it is known") {
  Counts counts;
  for (std::uint64_t seed = 0; seed < repeats(20); ++seed) {
    const Shape ring = turned(shape_of(models::torus(40, 20, 1, 0.4)), seed);
    const Shape dented = wobbled(shape_of(models::sphere(40, 24)), 0.08, seed);
    for (const double gap : {0.005, -0.01}) {
      check_vertices(near_bodies("ring and dented ball", ring, dented, 1, gap, 0.01), 4, counts);
      check_vertices(near_bodies("dented balls", dented, turned(dented, seed), 2, gap, 0.01), 4, counts);
    }
  }
  check_counts("gently curved bodies", counts);
}

TEST_CASE("follow: two edges lead to a contact that a query lists where they are known and apart") {
  Counts counts;
  std::size_t to_vertices = 0;
  std::size_t sunk_by_others = 0;  // by a face that one of them pierces by now
  for (std::uint64_t seed = 0; seed < repeats(40); ++seed)
    for (const Bodies& bodies : all_convex_bodies(100 * seed + 7)) {
      const Placed a(bodies.a);
      const Placed b(bodies.b);
      for (const Contact& contact :
           contacts_of(a, b, ContactDetail::nearest, bodies.reach, {true, true}).contacts) {
        if (contact.kind != ContactKind::EE || contact.distance == 0) continue;
        for (std::uint64_t pose = 0; pose < 6; ++pose) {
          CAPTURE(bodies.name, seed, pose, contact.feature_a.index, contact.feature_b.index);
          const Placed now_a(shaken(bodies.a, contact.point_a, bodies.motion, 2 * pose));
          const Placed now_b(shaken(bodies.b, contact.point_a, bodies.motion, 2 * pose + 1));
          const FollowedContact found = followed(now_a, now_b, contact);
          counts.add(found, contact);
          if (!found.is_known || found.geometry.separation <= 0) continue;
          CAPTURE(found.steps, static_cast<int>(found.feature_a.kind), static_cast<int>(found.feature_b.kind),
                  found.geometry.separation);
          check_geometry(now_a, now_b, found);
          const auto listed = contacts_of(now_a, now_b, ContactDetail::nearest, 0.5, {true, true}).contacts;
          const auto same = std::find_if(listed.begin(), listed.end(), [&](const Contact& other) {
            return other.feature_a == found.feature_a && other.feature_b == found.feature_b;
          });
          REQUIRE(same != listed.end());
          CHECK(std::abs(same->distance - found.geometry.distance) < 1e-12);
          sunk_by_others += same->separation() < 0 ? 1U : 0U;
          to_vertices +=
              found.feature_a.kind == FeatureKind::vertex || found.feature_b.kind == FeatureKind::vertex ? 1U
                                                                                                         : 0U;
        }
      }
    }
  std::cout << "edges: " << counts << ", " << to_vertices << " became contacts of vertices, "
            << sunk_by_others << " are sunk by now\n";
  CHECK(counts.moved > 0);
  CHECK(to_vertices > 0);
  CHECK(sunk_by_others * 100 < counts.known);
}

}  // namespace graze::tests
