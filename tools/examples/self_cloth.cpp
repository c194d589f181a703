// Lets a cloth of 26 × 26 vertices down onto a floor, edge first, so that it folds into layers that lie on
// each other. With `self` no edge of the cloth ever pierces it. Without it many do.
//
// The thickness of the cloth is the gap. The contact distance is more than the gap, but less than 0.7 of an
// edge of the cloth: then no features are that near at rest. So all of them count, with `self_rings` = 0,
// also those that are joined by an edge.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <utility>

#include "examples/support/record_option.hpp"
#include "examples/support/world.hpp"

namespace {

constexpr int frames = 300;
constexpr int looks = 2;                // steps of graze in a frame
constexpr double time_step = 1.0 / 60;  // s
constexpr double width = 0.75;          // m, with edges of 3 cm
constexpr int vertices = 26;            // along a side
constexpr double gap = 0.008;           // m, the thickness of the cloth
constexpr double pace = 0.4;            // m/s, how fast it is let down

/// Counts the edges of a surface that pierce it, by the contacts of its pair with itself.
std::size_t count_piercing(const graze::FrameReport& report) {
  std::size_t count = 0;
  for (const graze::PairReport& pair : report.pairs())
    if (pair.a == pair.b)
      for (const graze::Contact& contact : report.contacts(pair))
        count += contact.kind == graze::ContactKind::EF && contact.distance == 0;
  return count;
}

/// The state of the cloth at the end, by a scene of its own.
struct Outcome {
  std::size_t piercing = 0;  ///< edges that pierce the cloth
  double apart = 0;          ///< m, between the two nearest features that are not neighbours
  double height = 0;         ///< m, of the highest vertex
};

Outcome look_at(const examples::Body& cloth) {
  graze::Scene scene({.contact_distance = gap, .detail = graze::ContactDetail::nearest, .threads = 1});
  const graze::ObjectId id = scene.add(cloth.mesh, {.self = true, .self_rings = 0});
  scene.set_positions(id, cloth.positions);
  const graze::ReportHandle report = scene.step();
  Outcome outcome{count_piercing(*report), gap, 0};
  if (!report->pairs().empty()) outcome.apart = report->pairs()[0].distance.lower;
  for (const Eigen::Vector3d& point : cloth.positions) outcome.height = std::max(outcome.height, point.z());
  return outcome;
}

/// Holds the upper row of the cloth, lets it down, and lets go of it near the floor.
void guide(examples::Body& cloth, double inverse_mass) {
  const bool is_held = cloth.positions.back().z() > 0.1;
  for (std::size_t i = cloth.positions.size() - vertices; i < cloth.positions.size(); ++i) {
    cloth.inverse_masses[i] = is_held ? 0 : inverse_mass;
    if (is_held) cloth.velocities[i] = {0, 0, -pace};
  }
}

bool holds(bool meets_itself, int argc, char** argv) {
  examples::WorldSettings settings;
  settings.contact_distance = 0.02;
  settings.contacts.gap = gap;
  settings.contacts.friction = 0.3;
  settings.damping = 2;
  settings.substeps = 5;
  settings.iterations = 2;
  examples::World world(settings);
  world.add(examples::fixed_body(examples::floor_box(4, 0.5)));
  examples::Body sheet = examples::cloth(examples::hanging_sheet(width, vertices, 0.01, 12), 0.3);
  sheet.meets_itself = meets_itself;
  examples::Body& cloth = world.add(std::move(sheet));
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  const double inverse_mass = cloth.inverse_masses.front();
  std::size_t pierced = 0;
  for (int frame = 0; frame < frames; ++frame) {
    guide(cloth, inverse_mass);
    for (int look = 0; look < looks; ++look) pierced += count_piercing(*world.step(time_step / looks));
  }
  const Outcome end = look_at(cloth);
  std::printf("%s self: %zu edges pierce on the way, %zu at the end, %.1f mm apart, %.1f cm high\n",
              meets_itself ? "with" : "without", pierced, end.piercing, 1e3 * end.apart, 1e2 * end.height);
  if (!meets_itself) return end.piercing > 0;
  return pierced == 0 && end.piercing == 0 && end.apart > gap / 2 && end.height < 0.15;
}

}  // namespace

int main(int argc, char** argv) {
  const bool with_self = holds(true, argc, argv);
  const bool without_self = holds(false, argc, argv);
  std::printf("%s\n", with_self && without_self ? "the cloth lies on itself in layers" : "went wrong");
  return with_self && without_self ? 0 : 1;
}
