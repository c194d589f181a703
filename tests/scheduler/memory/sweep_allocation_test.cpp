// Steps that sweep take no memory after one period, whatever meets on the way.

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/graze.hpp>
#include <iostream>
#include <memory>
#include <vector>

#include "scheduler/memory/allocation_count.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// Balls that fly through each other, and a sheet that folds through itself. All of it was calculated before.
class FlyingAndFolding {
 public:
  static constexpr std::size_t period = 6;
  static constexpr std::size_t ball_count = 6;

  explicit FlyingAndFolding(const SceneSettings& settings) : scene_(settings) {
    ObjectSettings swept;
    swept.swept = true;
    const auto ball = mesh_of(models::sphere(8, 6));
    for (std::size_t i = 0; i < ball_count; ++i) {
      balls_[i] = scene_.add(ball, i % 3 == 0 ? ObjectSettings() : swept);
      for (std::size_t frame = 0; frame < period; ++frame)
        flights_[frame][i] = moved(ball->rest(), flight_of(i, frame));
    }
    swept.self = true;
    const auto cloth = mesh_of(models::sheet(6, 6, 6, 6));
    sheet_ = scene_.add(cloth, swept);
    for (std::size_t frame = 0; frame < period; ++frame) folds_[frame] = folded(cloth->rest(), frame);
  }

  ReportHandle step(std::size_t frame) {
    const std::size_t now = frame % period;
    for (std::size_t i = 0; i < ball_count; ++i) {
      // Now and then one jumps.
      if ((frame + i) % 5 == 0)
        scene_.set_positions(balls_[i], flights_[now][i], teleport);
      else
        scene_.set_positions(balls_[i], flights_[now][i]);
    }
    scene_.set_positions(sheet_, folds_[now]);
    return scene_.step();
  }

 private:
  static double phase_of(std::size_t frame) {
    return 2 * 3.14159265358979 * static_cast<double>(frame) / static_cast<double>(period);
  }
  static Eigen::Vector3d flight_of(std::size_t ball, std::size_t frame) {
    const double own = static_cast<double>(ball);
    const double phase = phase_of(frame) + own;
    return {3 * std::cos(phase), 3 * std::sin(2 * phase + own), std::sin(phase - own)};
  }
  /// One half of the sheet swings through the other one.
  static Positions folded(std::span<const Eigen::Vector3d> rest, std::size_t frame) {
    const double angle = 4.4 * std::sin(phase_of(frame)) + 0.01;
    Positions positions(rest.begin(), rest.end());
    for (Eigen::Vector3d& position : positions) {
      const double beyond = std::max(position.x(), 0.0);
      position.x() += beyond * (std::cos(angle) - 1);
      position.z() +=
          beyond * std::sin(angle) + 0.1 * position.x() * position.x() + 0.07 * position.y() * position.y();
      position.z() += 10;
    }
    return positions;
  }

  Scene scene_;
  std::array<ObjectId, ball_count> balls_;
  std::array<std::array<Positions, ball_count>, period> flights_;
  ObjectId sheet_;
  std::array<Positions, period> folds_;
};

/// Balls that fly towards a wall for a while, some of them added on the way, and then pass through it.
class Volley {
 public:
  static constexpr std::size_t frames_aloft = 8;
  static constexpr std::size_t all_frames = 30;
  static constexpr std::size_t ball_count = 12;

  explicit Volley(const SceneSettings& settings) : scene_(settings) {
    scene_.add(mesh_of(models::sheet(8, 8, 16, 16)), {.motion = Motion::fixed});
    for (std::size_t ball = 0; ball < ball_count / 2; ++ball) add();
  }
  Scene& scene() { return scene_; }

  ReportHandle step(std::size_t frame) {
    if (frame == frames_aloft / 2)
      while (balls_.size() < ball_count) add();
    for (std::size_t ball = 0; ball < balls_.size(); ++ball) {
      const Positions& positions = flights_[ball][frame];
      scene_.set_positions(balls_[ball], positions);
    }
    return scene_.step();
  }

 private:
  void add() {
    const double own = static_cast<double>(balls_.size());
    balls_.push_back(scene_.add(ball_, {.swept = true}));
    for (std::size_t frame = 0; frame < all_frames; ++frame) {
      const double height = 0.7 + 1.9 * (static_cast<double>(frames_aloft) - static_cast<double>(frame));
      const Eigen::Vector3d place(3 * std::fmod(own, 4) - 4.5, 3 * std::floor(own / 4) - 3,
                                  height - 0.1 * own);
      flights_[balls_.size() - 1][frame] = moved(ball_->rest(), place);
    }
  }

  Scene scene_;
  std::shared_ptr<const Mesh> ball_ = mesh_of(models::sphere(8, 6));
  std::vector<ObjectId> balls_;
  std::array<std::array<Positions, all_frames>, ball_count> flights_;
};

}  // namespace

TEST_CASE("no allocation: swept bodies that pass each other, and a sheet that passes itself") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto threads = GENERATE(1U, 2U);
  const bool is_limited = GENERATE(false, true);
  CAPTURE(threads, is_limited);
  SceneSettings settings = settings_of(0.05, 0.3, ContactDetail::none);
  settings.threads = threads;
  if (is_limited) {
    settings.swept_gap = 0.1;
    settings.max_contacts_per_pair = 8;
  }
  FlyingAndFolding scene(settings);
  constexpr std::size_t warm_up = 5 * FlyingAndFolding::period;  // as long as the jumps take to come again
  std::array<ReportHandle, 3> held;
  std::size_t impacts = 0;
  std::size_t of_sheet = 0;
  for (std::size_t frame = 0; frame < warm_up; ++frame) held[frame % held.size()] = scene.step(frame);
  AllocationCount::begin();
  for (std::size_t frame = warm_up; frame < 2 * warm_up; ++frame) {
    ReportHandle& report = held[frame % held.size()];
    report = scene.step(frame);
    impacts += report->impacts().size();
    for (const PairReport& pair : report->pairs())
      if (pair.a == pair.b) of_sheet += pair.impact_count;
  }
  AllocationCount::end();
  INFO(AllocationCount::first_of_others());
  CHECK(AllocationCount::by_tbb() == 0);
  CHECK(AllocationCount::by_others() == 0);
  CHECK(AllocationCount::by_exceptions() == 0);
  CHECK(impacts > 50);
  CHECK(of_sheet > 5);
}

TEST_CASE("first impacts take no memory where room was reserved") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto threads = GENERATE(1U, 2U);
  const bool is_reserved = GENERATE(true, false);
  CAPTURE(threads, is_reserved);
  SceneSettings settings = settings_of(0.05, 0.3, ContactDetail::none);
  settings.threads = threads;
  settings.swept_gap = 0.1;
  Volley volley(settings);
  if (is_reserved)
    volley.scene().reserve({.objects = Volley::ball_count + 1,
                            .calls_per_step = 2 * Volley::ball_count,
                            .near_pairs = 100,
                            .contacts = 100,
                            .reports = 4,
                            .impacts = 5'000});
  for (std::size_t frame = 0; frame < Volley::frames_aloft; ++frame)
    CHECK(volley.step(frame)->impacts().empty());
  std::array<ReportHandle, 4> held;
  std::size_t impacts = 0;
  AllocationCount::begin();
  for (std::size_t frame = Volley::frames_aloft; frame < Volley::all_frames; ++frame) {
    ReportHandle& report = held[frame % held.size()];
    report = volley.step(frame);
    impacts += report->impacts().size();
  }
  AllocationCount::end();
  CHECK(impacts > 50);
  INFO(AllocationCount::first_of_others());
  if (is_reserved) {
    CHECK(AllocationCount::by_tbb() == 0);
    CHECK(AllocationCount::by_others() == 0);
  } else {
    CHECK(AllocationCount::by_others() > 5);
  }
}

}  // namespace graze::tests
