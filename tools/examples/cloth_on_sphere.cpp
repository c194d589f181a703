// Lets a cloth of 40 × 40 vertices fall over a sphere, with XPBD, and drags the sphere to the side a little
// while the cloth lies on it. At the end no vertex of the cloth is inside the sphere, and no edge pierces.
//
// graze looks once in each frame. The contact distance is more than surfaces come nearer in a frame. Between
// two looks the contacts are evaluated at the positions of each substep.
//
// The sphere is solid. The cloth has no inside: it may touch the sphere with either side. Friction holds it
// on the sphere. The cloth passes through itself where it folds: this example looks at one pair alone.

#include <Eigen/Core>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>

#include "examples/support/record_option.hpp"
#include "examples/support/world.hpp"

namespace {

constexpr int frames = 300;
constexpr double time_step = 1.0 / 60;  // s

struct Count {
  std::size_t contacts = 0;
  std::size_t inside = 0;    ///< vertices of the cloth inside the sphere
  std::size_t piercing = 0;  ///< edges that pierce a face
};

/// The sphere was added first, so it is a.
Count count(const graze::FrameReport& report) {
  Count found;
  for (const graze::Contact& contact : report.contacts()) {
    ++found.contacts;
    found.inside +=
        contact.feature_b.kind == graze::FeatureKind::vertex && contact.side_a == graze::Side::back;
    found.piercing += contact.kind == graze::ContactKind::EF && contact.distance == 0;
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  examples::WorldSettings settings;
  settings.contact_distance = 0.04;
  settings.contacts.gap = 0.005;
  settings.contacts.friction = 0.5;
  settings.damping = 1;
  settings.substeps = 5;
  settings.iterations = 3;
  examples::World world(settings);
  examples::Body& sphere = world.add(examples::fixed_body(examples::ball(0.3, 32, 15)));
  const examples::Body& cloth =
      world.add(examples::cloth(moved(examples::sheet(1.2, 40), {0.05, 0, 0.35}), 0.3));
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, world.scene());

  for (int frame = 0; frame < frames; ++frame) {
    const bool is_dragged = frame >= 150 && frame < 210;
    sphere.velocities.assign(sphere.velocities.size(), Eigen::Vector3d(is_dragged ? 0.1 : 0, 0, 0));
    world.step(time_step);
    if (frame % 50 == 49) {
      const Count found = count(*world.look());
      std::printf("frame %3d: %4zu contacts, %zu inside, %zu piercing, speed %.3f m/s\n", frame + 1,
                  found.contacts, found.inside, found.piercing, examples::largest_speed(cloth));
    }
  }
  const graze::ReportHandle report = world.look();
  const Count found = count(*report);
  const bool is_crossing = report->pairs().empty() || report->pairs()[0].inside != graze::Inside::none;
  const bool holds = found.contacts > 0 && found.inside == 0 && found.piercing == 0 && !is_crossing;
  std::printf("%zu vertices inside the sphere, %zu edges pierce\n", found.inside, found.piercing);
  return holds ? 0 : 1;
}
