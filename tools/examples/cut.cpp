// Cuts a cloth in two while it lies over two bars. Every fifth step cuts one more edge along the middle:
// Scene::replace_mesh gives the cloth a mesh in which one more vertex is doubled. The contacts on the bars go
// on: their pairs stay `touching`, and each keeps the frame in which it began. At the end the halves hang
// over one bar each, and no vertex is inside a bar.

#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <graze/graze.hpp>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "examples/support/contact_constraint.hpp"
#include "examples/support/record_option.hpp"
#include "examples/support/xpbd.hpp"

namespace {

constexpr std::uint32_t side = 41;          // vertices of the cloth along each side, an odd number
constexpr double width = 1;                 // m
constexpr double mass = 0.3;                // kg
constexpr double contact_distance = 0.015;  // m
constexpr double time_step = 1.0 / 300;     // s
constexpr double damping = 5;               // 1/s
constexpr int steps = 900;
constexpr int cut_from = 400;  // the step of the first cut
constexpr int steps_per_cut = 5;

/// Returns the flat sheet with the first `edges` edges of its middle column cut. The vertices along the cut
/// are doubled: the faces to the right of it use new ones at the end of the list. The tip is not.
examples::Shape cut_sheet(std::uint32_t edges) {
  examples::Shape shape = examples::sheet(width, int{side});
  const std::uint32_t doubled = edges == side - 1 ? side : edges;
  for (std::uint32_t row = 0; row < doubled; ++row) {
    const std::uint32_t old = row * side + side / 2;
    const auto copy = static_cast<std::uint32_t>(shape.points.size());
    shape.points.emplace_back(shape.points[old]);
    for (auto& triangle : shape.triangles) {
      const bool is_right = std::ranges::any_of(
          triangle, [&](auto corner) { return shape.points[corner].x() > width / side / 2; });
      if (is_right) std::replace(triangle.begin(), triangle.end(), old, copy);
    }
  }
  return shape;
}

/// Returns a bar along y, whose top is in the middle of the plane z = 0.
examples::Shape bar() {
  examples::Shape shape = examples::floor_box(1, 1);
  for (Eigen::Vector3d& point : shape.points) point = point.cwiseProduct(Eigen::Vector3d(0.06, 1.2, 0.06));
  return shape;
}

/// Cuts the cloth up to an edge. Old vertices keep their numbers. A new one has the position and the velocity
/// of its twin.
void cut(graze::Scene& scene, graze::ObjectId id, examples::Body& cloth, std::uint32_t edges) {
  examples::Body after = examples::cloth(cut_sheet(edges), mass);
  const std::size_t before = cloth.positions.size();
  for (std::size_t i = 0; i < after.positions.size(); ++i) {
    const std::size_t from = i < before ? i : (i - side * side) * side + side / 2;
    after.positions[i] = cloth.positions[from];
    after.velocities[i] = cloth.velocities[from];
  }
  std::vector<std::uint32_t> new_of_old(before);
  std::iota(new_of_old.begin(), new_of_old.end(), 0U);
  scene.replace_mesh(id, after.mesh, new_of_old);  // this also ends the binding of the old positions
  cloth = std::move(after);
  scene.bind_positions(id, cloth.positions);
}

/// Compares the contacts of a report with those of the last one before a cut. Edges of the cloth have other
/// numbers in each mesh, so their contacts are left out.
struct Survivors {
  std::size_t kept = 0;  ///< contacts of the same features that are as old as before
  std::size_t lost = 0;  ///< those that are not

  void count(const graze::FrameReport& before, const graze::FrameReport& after) {
    for (std::size_t i = 0; i < std::min(before.pairs().size(), after.pairs().size()); ++i)
      for (const graze::Contact& old : before.contacts(before.pairs()[i]))
        for (const graze::Contact& now : after.contacts(after.pairs()[i])) {
          const bool is_same = old.feature_a == now.feature_a && old.feature_b == now.feature_b;
          if (!is_same || old.feature_b.kind == graze::FeatureKind::edge) continue;
          ++(now.since == old.since ? kept : lost);
        }
  }
};

void move(std::deque<examples::Body>& bodies, const std::vector<examples::ContactConstraint>& constraints) {
  for (examples::Body& body : bodies) predict(body, {0, 0, -9.81}, damping, time_step);
  for (int i = 0; i < 4; ++i) {
    for (examples::Body& body : bodies) solve_springs(body, time_step);
    for (const examples::ContactConstraint& constraint : constraints) solve(constraint, {}, time_step);
  }
  for (examples::Body& body : bodies) update_velocities(body, time_step);
}

/// Returns whether the cloth still touches both bars, and no vertex is inside one.
bool are_touching(const graze::FrameReport& report) {
  return report.pairs().size() == 2 && std::ranges::all_of(report.pairs(), [](const graze::PairReport& pair) {
           return pair.phase == graze::PairPhase::touching && pair.inside == graze::Inside::none;
         });
}

}  // namespace

int main(int argc, char** argv) {
  graze::Scene scene(
      {.contact_distance = contact_distance, .detail = graze::ContactDetail::nearest, .threads = 1});
  std::deque<examples::Body> bodies;
  for (const double x : {-0.25, 0.25}) bodies.push_back(examples::fixed_body(moved(bar(), {x, 0, -0.01})));
  bodies.push_back(examples::cloth(cut_sheet(0), mass));
  graze::ObjectId cloth;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    graze::ObjectSettings object;
    object.user_data = i;
    object.solid = bodies[i].is_solid;
    object.motion = i < 2 ? graze::Motion::fixed : graze::Motion::deformable;
    cloth = scene.add(bodies[i].mesh, object);
  }
  scene.bind_positions(cloth, bodies[2].positions);
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, scene);
  std::uint32_t edges = 0;
  Survivors survivors;
  bool holds = true;
  graze::ReportHandle last;
  std::vector<examples::ContactConstraint> constraints;
  for (int step = 0; step < steps; ++step) {
    const bool cuts = step >= cut_from && step % steps_per_cut == 0 && edges < side - 1;
    if (cuts) cut(scene, cloth, bodies[2], ++edges);
    const graze::ReportHandle report = scene.step();
    if (cuts) survivors.count(*last, *report);
    if (step >= cut_from) holds = holds && are_touching(*report);
    if (step % 200 == 199)
      std::printf("step %4d: %zu contacts, %u edges cut\n", step + 1, report->contacts().size(), edges);
    collect_constraints(*report, bodies, constraints);
    move(bodies, constraints);
    last = report;
  }
  const auto older = std::ranges::count_if(
      last->contacts(), [](const graze::Contact& contact) { return contact.since <= cut_from; });
  const double parted = (bodies[2].positions[side / 2] - bodies[2].positions[side * side]).norm();
  std::printf(
      "%zu contacts survived a cut, %zu lost their age; %td began before all cuts; halves %.2f m apart\n",
      survivors.kept, survivors.lost, older, parted);
  return holds && survivors.kept > 0 && survivors.lost == 0 && older > 0 && parted > 0.1 ? 0 : 1;
}
