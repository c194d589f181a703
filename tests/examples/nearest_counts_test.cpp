// How many contacts `nearest` has by the pairs of edges that bound patches, against those that are locally
// closest alone. Soft bodies gain few, and a crate on a crate has few in all.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "examples/support/world.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/edge_comparison.hpp"

namespace graze::tests {
namespace {

using oracle::Creases;
using oracle::EdgePair;
using oracle::Shape;

/// The used vertices of a body and its faces, where they are, or at rest.
Shape shape_of(const examples::Body& body, std::span<const Eigen::Vector3d> positions) {
  Shape shape{{positions.begin(), positions.end()}, {}};
  for (std::uint32_t face = 0; face < body.mesh->face_count(); ++face)
    shape.faces.emplace_back(body.mesh->face(face).begin(), body.mesh->face(face).end());
  return shape;
}

/// Contacts of `nearest`, and those of them that are listed only since they bound a patch.
struct ContactCounts {
  std::size_t all = 0;
  std::size_t gained = 0;

  /// Counts a pair. Its edges have to be the oracle's.
  void add(std::span<const Contact> contacts, const std::vector<EdgePair>& pairs,
           const Tolerance& tolerance) {
    CHECK(edge_difference(ContactDetail::nearest, contacts, pairs, tolerance) == "");
    all += contacts.size();
    for (const EdgePair& pair : pairs) gained += pair.is_listed() && !pair.is_locally_closest ? 1U : 0U;
  }
  /// Contacts gained, in hundredths of those that there were without.
  [[nodiscard]] double percent() const {
    return 100 * static_cast<double>(gained) / static_cast<double>(all - gained);
  }
  void print(const char* what) const {
    std::cout << what << ": " << all - gained << " contacts, and " << gained
              << " pairs of edges that bound a patch: " << percent() << " % more\n";
  }
};

/// Counts the contacts of a world now.
void count(examples::World& world, double contact_distance, ContactCounts& counts) {
  const ReportHandle report = world.look();
  const auto& bodies = world.bodies();
  for (const PairReport& row : report->pairs()) {
    const auto contacts = report->contacts(row);
    if (contacts.empty()) continue;
    const examples::Body& a = bodies[row.a.index];
    const examples::Body& b = bodies[row.b.index];
    const Shape now_a = shape_of(a, a.positions);
    const Shape now_b = shape_of(b, b.positions);
    const Creases creases(shape_of(a, a.mesh->rest()), shape_of(b, b.mesh->rest()));
    counts.add(contacts, edge_pairs_of(now_a, now_b, contact_distance, creases), {now_a, now_b});
  }
}

/// A closed box about the origin.
Shape box_shape(const Eigen::Vector3d& half) {
  const examples::Shape box = examples::box(2 * half);
  Shape shape{box.points, {}};
  for (const auto& triangle : box.triangles) shape.faces.emplace_back(triangle.begin(), triangle.end());
  return shape;
}

examples::WorldSettings settings_of_world(double contact_distance) {
  examples::WorldSettings settings;
  settings.contact_distance = contact_distance;
  settings.damping = 1;
  settings.substeps = 5;
  settings.contacts.gap = contact_distance / 3;
  return settings;
}

/// Lets a world come to rest, and counts its contacts now and then.
ContactCounts counts_of(examples::World& world, double contact_distance) {
  ContactCounts counts;
  for (int step = 1; step <= 240; ++step) {
    world.step(1.0 / 120);
    if (step % 40 == 0) count(world, contact_distance, counts);
  }
  return counts;
}

void add_ball(examples::World& world, double radius, int segments, const Eigen::Vector3d& at) {
  const examples::Shape ball = examples::ball(radius, segments, 2 * segments / 3);
  world.add(examples::soft_ball(moved(ball, at), at, 0.5, 1e-4));
}

/// A thick block of which the upper side has hills.
examples::Shape hills(int cells, double width) {
  examples::Shape shape = examples::sheet(width, cells + 1);
  const auto top = static_cast<std::uint32_t>(shape.points.size());
  for (Eigen::Vector3d& p : shape.points)
    p.z() = 0.03 * std::sin(9 * p.x()) * std::cos(8 * p.y()) - 0.3 * (0.05 - p.squaredNorm());
  // The under side is the upper one lowered and turned over; the sides join their rims.
  const auto triangles = shape.triangles;
  for (std::uint32_t i = 0; i < top; ++i)
    shape.points.push_back(shape.points[i] - Eigen::Vector3d(0, 0, 0.5));
  for (const auto& [p, q, r] : triangles) shape.triangles.push_back({top + p, top + r, top + q});
  std::set<std::array<std::uint32_t, 2>> sides;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) sides.insert({t[i], t[(i + 1) % 3]});
  for (const auto& [p, q] : sides)
    if (!sides.contains({q, p})) {
      shape.triangles.push_back({q, p, top + p});
      shape.triangles.push_back({q, top + p, top + q});
    }
  return shape;
}

}  // namespace

TEST_CASE("counts of nearest: soft balls on a terrain gain few contacts") {
  examples::World world(settings_of_world(0.015));
  world.add(examples::fixed_body(hills(16, 1)));
  for (int i = 0; i < 2; ++i) add_ball(world, 0.1, 32, {0.22 * i - 0.15, 0.2 * i - 0.12, 0.15});
  const ContactCounts counts = counts_of(world, 0.015);
  CHECK(counts.all > 200);
  CHECK(counts.gained > 0);
  CHECK(counts.percent() < 15);
  counts.print("soft balls on a terrain");
}

TEST_CASE("counts of nearest: fine bodies gain next to no contacts") {
  examples::World world(settings_of_world(0.01));
  world.add(examples::fixed_body(examples::ball(0.3, 80, 53)));
  world.add(examples::cloth(moved(examples::sheet(0.6, 20), {0.02, 0, 0.31}), 0.3));
  const ContactCounts counts = counts_of(world, 0.01);
  CHECK(counts.all > 200);
  CHECK(counts.percent() < 1);
  counts.print("a cloth on a fine ball");
}

TEST_CASE("counts of nearest: soft balls on crates gain at most a quarter") {
  examples::World world(settings_of_world(0.015));
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d at(0.24 * (i % 3) - 0.24, 0.26 * static_cast<double>(i / 3) - 0.13, 0.06);
    examples::Shape crate = examples::box({0.15, 0.15, 0.12});
    for (Eigen::Vector3d& p : crate.points) p = at + Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitZ()) * p;
    world.add(examples::fixed_body(crate));
    add_ball(world, 0.1, 16, at + Eigen::Vector3d(0.03 * i - 0.07, 0.04, 0.19));
  }
  const ContactCounts counts = counts_of(world, 0.015);
  CHECK(counts.all > 100);
  CHECK(counts.gained > 0);
  CHECK(counts.percent() < 25);
  counts.print("soft balls on crates");
}

TEST_CASE("counts of nearest: a crate on a crate has at most 16 pairs of edges") {
  const Shape crate = box_shape({0.25, 0.25, 0.25});
  std::size_t most = 0;
  for (const double yaw : {0.0, 0.047, 0.4, 0.785, 1.2})
    for (const double tilt : {0.0, 1e-6, 1e-3})
      for (const double gap : {0.005, 0.001, -0.001, -0.01}) {
        Scene scene(settings_of(0.02, 0.02, ContactDetail::nearest));
        scene.add(mesh_of(crate), motion_of(Motion::rigid));
        const ObjectId upper = scene.add(mesh_of(crate), motion_of(Motion::rigid));
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.linear() = (Eigen::AngleAxisd(tilt, Eigen::Vector3d(0.8, 0.6, 0)) *
                         Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()))
                            .toRotationMatrix();
        pose.translation() = Eigen::Vector3d(0.03, 0.02, 0.5 + gap);
        scene.set_pose(upper, pose);
        const ReportHandle report = scene.step();
        const auto edges = static_cast<std::size_t>(
            std::count_if(report->contacts().begin(), report->contacts().end(),
                          [](const Contact& contact) { return contact.kind == ContactKind::EE; }));
        INFO("yaw " << yaw << ", tilt " << tilt << ", gap " << gap);
        CHECK(edges <= 16);
        most = std::max(most, edges);
      }
  CHECK(most >= 8);
  std::cout << "a crate on a crate has at most " << most << " pairs of edges\n";
}

}  // namespace graze::tests
