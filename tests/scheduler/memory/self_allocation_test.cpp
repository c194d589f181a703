// Steps about a surface that touches itself take no memory after one period.

#include <array>
#include <cmath>
#include <graze/graze.hpp>
#include <iostream>
#include <vector>

#include "scheduler/memory/allocation_count.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t frames_of_fold = 12;

/// A sheet whose one half swings onto the other one, and through it, in each frame.
std::array<Positions, frames_of_fold> folds_of(const Mesh& sheet) {
  std::array<Positions, frames_of_fold> frames;
  for (std::size_t frame = 0; frame < frames_of_fold; ++frame) {
    const double angle = 2.3 + std::sin(2 * 3.14159265358979 * static_cast<double>(frame) / frames_of_fold);
    for (const Eigen::Vector3d& rest : sheet.rest()) {
      const double beyond = std::max(rest.x(), 0.0);
      frames[frame].emplace_back(rest.x() + beyond * (std::cos(angle) - 1), rest.y(),
                                 beyond * std::sin(angle) + 0.05 * rest.x() * rest.y());
    }
  }
  return frames;
}

}  // namespace

TEST_CASE("no allocation: a sheet that folds onto itself and through itself") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto detail = GENERATE(from_range(all_details));
  const auto threads = GENERATE(1U, 2U);
  const auto limit = GENERATE(0, 1, 2);
  CAPTURE(name_of(detail), threads, limit);
  SceneSettings settings = settings_of(0.2, 1, detail);
  settings.threads = threads;
  if (limit == 1) settings.max_contacts_per_pair = 9;
  if (limit == 2) settings.max_contacts = 20;
  Scene scene(settings);
  const auto mesh = mesh_of(models::sheet(6, 4, 6, 4));
  const auto frames = folds_of(*mesh);
  const ObjectId sheet = scene.add(mesh, {.self = true});
  std::array<ReportHandle, 3> held;
  std::size_t in_contact = 0;
  const auto play = [&] {
    for (std::size_t frame = 0; frame < frames_of_fold; ++frame) {
      scene.set_positions(sheet, frames[frame]);
      held[frame % held.size()] = scene.step();
      in_contact += held[frame % held.size()]->statistics().pairs_in_contact;
    }
  };
  for (int period = 0; period < 4; ++period) play();
  in_contact = 0;
  AllocationCount::begin();
  play();
  play();
  AllocationCount::end();
  INFO(AllocationCount::first_of_others());
  CHECK(AllocationCount::by_tbb() == 0);
  CHECK(AllocationCount::by_others() == 0);
  CHECK(AllocationCount::by_exceptions() == 0);
  if (detail == ContactDetail::regions) return;  // it has no pairs of one object
  CHECK(in_contact > 1);
  CHECK(in_contact < 2 * frames_of_fold);
}

}  // namespace graze::tests
