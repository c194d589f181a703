// Glues two soft balls together, each of which has a flat side. The upper one is held by its centre, which
// swings, and the lower one hangs on the glue. The glued faces are in group 1 of each ball, and Scene::ignore
// takes these out against each other: contacts would open the glue, since they want a wider gap. The rest of
// the flat sides is in contact as ever. At the end Scene::watch puts the glued faces back, and they have
// contacts too.
//
// The glue is made from a report: each contact of a vertex on the patches becomes a tie of its two points.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <graze/graze.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "examples/support/contact_constraint.hpp"
#include "examples/support/record_option.hpp"
#include "examples/support/tie.hpp"
#include "examples/support/xpbd.hpp"

namespace {

using examples::Body;

constexpr double radius = 0.2;              // m, of a ball
constexpr double flat = 0.16;               // m, from its centre to its flat side
constexpr double thickness = 0.001;         // m, of the glue: less than the gap that contacts keep
constexpr double patch = 0.08;              // m, radius of the glue
constexpr double contact_distance = 0.015;  // m
constexpr double time_step = 1.0 / 600;     // s
constexpr int steps = 1200;
constexpr std::uint8_t glued = 1;  // the group of faces

/// Returns a ball above or below the origin, whose flat side is towards the origin.
Body flat_ball(double sign) {
  examples::Shape shape = examples::ball(radius, 24, 17);
  const Eigen::Vector3d centre(0, 0, sign * (flat + thickness / 2));
  for (Eigen::Vector3d& point : shape.points) {
    point.z() = sign * std::max(sign * point.z(), -flat);
    point += centre;
  }
  return examples::soft_ball(shape, centre, 1, 1e-4);
}

/// Returns the group of each face of a ball at rest: `glued` in the middle of the flat side.
std::vector<std::uint8_t> groups_of(const graze::Mesh& mesh) {
  std::vector<std::uint8_t> groups(mesh.face_count(), glued);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    for (const std::uint32_t corner : mesh.face(face))
      if (mesh.rest()[corner].norm() > patch) groups[face] = 0;
  return groups;
}

/// Two balls, a scene of them, and their glue.
class Simulation {
 public:
  explicit Simulation(graze::Scene& scene) {
    for (std::size_t i = 0; i < 2; ++i) {
      bodies_.push_back(flat_ball(i == 0 ? 1 : -1));
      graze::ObjectSettings object;
      object.solid = bodies_[i].is_solid;
      object.user_data = i;
      object.face_groups = groups_[i] = groups_of(*bodies_[i].mesh);
      ids[i] = scene.add(bodies_[i].mesh, object);
      scene.bind_positions(ids[i], bodies_[i].positions);
    }
    bodies_[0].inverse_masses.back() = 0;  // its centre
  }

  /// Ties the points of each contact of glued vertices.
  void glue(const graze::FrameReport& report) {
    for (const graze::Contact& contact : report.contacts())
      if (contact.kind != graze::ContactKind::EE && is_glue(contact))
        ties_.push_back(examples::tie_of(contact, bodies_[0], bodies_[1]));
  }

  void step(const graze::FrameReport& report, double speed) {
    collect_constraints(report, bodies_, constraints_);
    bodies_[0].velocities.back() = {speed, 0, 0};
    for (Body& body : bodies_) predict(body, {0, 0, -9.81}, 0.1, time_step);
    for (int i = 0; i < 4; ++i) {
      for (Body& body : bodies_) solve_springs(body, time_step);
      const Eigen::Vector3d down = (bodies_[1].positions.back() - bodies_[0].positions.back()).normalized();
      for (const examples::Tie& tie : ties_) tie.solve(thickness * down);
      for (const auto& constraint : constraints_) solve(constraint, {}, time_step);
    }
    for (Body& body : bodies_) update_velocities(body, time_step);
  }

  /// Returns by how much the longest tie is longer than the glue is thick.
  [[nodiscard]] double gap() const {
    double longest = 0;
    for (const examples::Tie& tie : ties_) longest = std::max(longest, tie.apart().norm());
    return longest - thickness;
  }

  /// Counts contacts between glued faces.
  [[nodiscard]] std::ptrdiff_t glue_contacts(const graze::FrameReport& report) const {
    return std::ranges::count_if(report.contacts(),
                                 [&](const graze::Contact& contact) { return is_glue(contact); });
  }

  std::array<graze::ObjectId, 2> ids;

 private:
  [[nodiscard]] bool is_glue(const graze::Contact& contact) const {
    return examples::all_faces_in(glued, groups_[0], *bodies_[0].mesh, contact.feature_a) &&
           examples::all_faces_in(glued, groups_[1], *bodies_[1].mesh, contact.feature_b);
  }

  std::deque<Body> bodies_;
  std::array<std::vector<std::uint8_t>, 2> groups_;
  std::vector<examples::Tie> ties_;
  std::vector<examples::ContactConstraint> constraints_;
};

}  // namespace

int main(int argc, char** argv) {
  graze::Scene scene(
      {.contact_distance = contact_distance, .detail = graze::ContactDetail::nearest, .threads = 1});
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, scene);
  Simulation simulation(scene);
  simulation.glue(*scene.step());
  scene.ignore(simulation.ids[0], glued, simulation.ids[1], glued);
  double gap = 0;
  bool holds = true;
  for (int step = 0; step < steps; ++step) {
    const graze::ReportHandle report = scene.step();
    const std::size_t beside = report->contacts().size();
    holds = holds && simulation.glue_contacts(*report) == 0 && beside > 0 &&
            report->pairs()[0].inside == graze::Inside::none;  // of the whole surfaces
    gap = std::max(gap, simulation.gap());
    if (step % 300 == 0) std::printf("step %4d: %zu contacts beside the glue\n", step, beside);
    simulation.step(*report, 0.8 * std::cos(2 * std::numbers::pi * step * time_step));
  }
  scene.watch(simulation.ids[0], glued, simulation.ids[1], glued);
  const auto watched = simulation.glue_contacts(*scene.step());
  std::printf("the glue opened by %.6f m; its contacts: %s ignored, %td watched\n", gap,
              holds ? "none" : "some", watched);
  return holds && gap < 0.001 && watched > 0 ? 0 : 1;
}
