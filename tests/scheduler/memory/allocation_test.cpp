// After one period of a periodic motion, or after `reserve`, no step and no call around it takes memory,
// whatever the detail, the number of threads, the budgets, and who else holds reports.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <graze/recorder.hpp>
#include <iostream>
#include <new>
#include <optional>
#include <thread>

#include "core/search/large_pair.hpp"
#include "scheduler/memory/allocation_count.hpp"
#include "scheduler/memory/bobbing.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t period = Bobbing::period;
constexpr std::size_t frame_count = 1000;
constexpr std::size_t fewer_frames = 300;

std::size_t count_of(const FrameReport& report, PairPhase phase) {
  return static_cast<std::size_t>(std::count_if(report.pairs().begin(), report.pairs().end(),
                                                [&](const PairReport& pair) { return pair.phase == phase; }));
}

/// Counts how some frames ended.
struct Played {
  std::size_t idle = 0;        ///< frames in which no pair began, or none ended
  std::size_t incomplete = 0;  ///< frames in which a budget ran out
  std::size_t diagnostics = 0;
};

enum class Stepping { step, step_async };

/// Plays the frames from `begin` to `end`. Three reports are held meanwhile.
Played play(Bobbing& bobbing, std::size_t begin, std::size_t end, Stepping stepping = Stepping::step) {
  std::array<ReportHandle, 3> held;
  Played played;
  for (std::size_t frame = begin; frame < end; ++frame) {
    ReportHandle& report = held[frame % held.size()];
    bobbing.tell(frame);
    if (stepping == Stepping::step) {
      report = bobbing.scene().step();
    } else {
      bobbing.scene().step_async();
      report = bobbing.scene().wait();
    }
    if (count_of(*report, PairPhase::began) == 0 || count_of(*report, PairPhase::ended) == 0) ++played.idle;
    if (!report->complete()) ++played.incomplete;
    played.diagnostics += report->diagnostics().size();
  }
  return played;
}

bool is_skipped() {
  if (!AllocationCount::is_possible()) std::cout << "skipped: the allocator cannot be replaced here\n";
  return !AllocationCount::is_possible();
}

void check_none() {
  INFO(AllocationCount::first_of_others());
  CHECK(AllocationCount::by_tbb() == 0);
  CHECK(AllocationCount::by_others() == 0);
}

/// Nor is an exception thrown.
void check_none_thrown() {
  check_none();
  CHECK(AllocationCount::by_exceptions() == 0);
}

/// In every frame pairs begin and end, without a diagnostic, and no memory is taken.
void check_play_takes_none(Bobbing& bobbing, std::size_t begin, std::size_t end,
                           Stepping stepping = Stepping::step) {
  AllocationCount::begin();
  const Played played = play(bobbing, begin, end, stepping);
  AllocationCount::end();
  CHECK(played.idle == 0);
  CHECK(played.diagnostics == 0);
  check_none_thrown();
}

/// A thread that takes reports at random, holds up to eight of them for some frames, and reads them.
class Reader {
 public:
  explicit Reader(const Scene& scene) : thread_([this, &scene] { run(scene); }) {}
  ~Reader() { end(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Waits until it has held that many at once.
  void wait_for(std::size_t held) const {
    while (most_held_ < held) std::this_thread::yield();
  }
  void end() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] std::size_t taken() const { return taken_; }
  [[nodiscard]] std::size_t longest() const { return longest_; }
  [[nodiscard]] std::size_t wrong() const { return wrong_; }

  static constexpr std::size_t capacity = 8;
  static constexpr std::size_t most_held = capacity + 1;  ///< with the one that it looks at

 private:
  struct Held {
    ReportHandle report;
    std::size_t contacts = 0;
    std::uint64_t until = 0;  ///< the frame at which it is let go of
  };
  void run(const Scene& scene) {
    oracle::Random random(7);
    std::array<Held, capacity> all;
    while (!ended_) {
      Held& held = all[random.below(capacity)];
      ReportHandle latest = scene.latest_report();
      if (latest->frame() >= held.until) {
        if (held.report) {
          // A report that was held must not have changed.
          if (held.report->contacts().size() != held.contacts) ++wrong_;
          longest_ = std::max<std::size_t>(longest_, latest->frame() - held.report->frame());
        }
        held.contacts = latest->contacts().size();
        held.until = latest->frame() + 1 + random.below(60);
        held.report = std::move(latest);
        ++taken_;
      }
      most_held_ = static_cast<std::size_t>(
          std::count_if(all.begin(), all.end(), [](const Held& one) { return bool(one.report); }));
      std::this_thread::yield();
    }
  }

  std::atomic<bool> ended_ = false;
  std::atomic<std::size_t> most_held_ = 0;
  std::atomic<std::size_t> taken_ = 0;
  std::atomic<std::size_t> longest_ = 0;
  std::atomic<std::size_t> wrong_ = 0;
  std::thread thread_;
};

/// Drops over a plate, too far for any pair to be near, that come down all at once: half of them rigid, half
/// by positions.
class Falling {
 public:
  static constexpr std::size_t side = 5;
  static constexpr std::size_t drops = side * side;
  static constexpr std::size_t frames_aloft = 20;

  explicit Falling(const SceneSettings& settings) : scene_(settings), mesh_(drop_mesh()) {
    scene_.add(mesh_of(models::sheet(24, 24, 6, 6)), motion_of(Motion::fixed));
    for (std::size_t drop = 0; drop < drops; ++drop) {
      ids_[drop] = scene_.add(mesh_, motion_of(drop % 2 == 0 ? Motion::rigid : Motion::deformable));
      positions_.emplace_back(mesh_->rest().begin(), mesh_->rest().end());
    }
    bind(1);
  }
  [[nodiscard]] Scene& scene() { return scene_; }
  ReportHandle step(std::size_t frame) {
    const double height = frame < frames_aloft ? 3 + 0.01 * static_cast<double>(frame % 2)
                                               : 0.1 + 0.02 * static_cast<double>(frame % 7);
    if (frame == 0) bind(3);
    for (std::size_t drop = 0; drop < drops; ++drop) {
      const Eigen::Vector3d at(1.1 * static_cast<double>(drop % side) - 2.2,
                               1.1 * static_cast<double>(drop / side) - 2.2,
                               height + 0.001 * static_cast<double>(drop));
      if (drop % 2 == 0) {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.translation() = at;
        scene_.set_pose(ids_[drop], pose);
      } else {
        for (std::size_t i = 0; i < positions_[drop].size(); ++i) positions_[drop][i] = mesh_->rest()[i] + at;
        if (drop % 6 == 5) scene_.set_positions(ids_[drop], positions_[drop]);
      }
    }
    return scene_.step();
  }

 private:
  /// A third of the deformable ones is bound before room is reserved, a third after that. The others are
  /// told.
  void bind(std::size_t which) {
    for (std::size_t drop = which; drop < drops; drop += 6)
      scene_.bind_positions(ids_[drop], positions_[drop]);
  }

  Scene scene_;
  std::shared_ptr<const Mesh> mesh_;
  std::array<ObjectId, drops> ids_;
  std::vector<Positions> positions_;
};

/// Solid bodies in each other that tremble at random, and rest in some stretches of frames. Reports are held
/// at random, beside the latest one. The same seed gives the same frames.
class Trembling {
 public:
  static constexpr std::size_t held_count = 3;
  /// From here on every deformable body has its copies.
  static constexpr std::size_t first_frames = 8;

  Trembling(const SceneSettings& settings, std::uint64_t seed) : scene_(settings), random_(seed) {
    const std::array meshes{mesh_of(models::sphere(10, 7)), mesh_of(models::box({0.7, 0.5, 0.9})),
                            mesh_of(models::torus(9, 6, 0.6, 0.25)),
                            mesh_of(models::sphere(8, 5, models::Faces::quads))};
    for (std::size_t i = 0; i < 9; ++i) {
      ObjectSettings object = motion_of(i % 3 == 2 ? Motion::deformable : Motion::rigid);
      object.solid = true;
      Body body{meshes[i % meshes.size()], {}, object.motion, random_.vector(-1, 1), {}};
      body.id = scene_.add(body.mesh, object);
      bodies_.push_back(body);
    }
  }
  [[nodiscard]] Scene& scene() { return scene_; }

  void play(std::size_t begin, std::size_t end) {
    for (std::size_t frame = begin; frame < end; ++frame) {
      if (frame < first_frames || frame / 5 % 2 == 0)
        for (Body& body : bodies_) move(body, frame < first_frames ? 0 : 0.02);
      ReportHandle report = scene_.step();
      const StepStatistics& statistics = report->statistics();
      near_pairs =
          std::max({near_pairs, static_cast<std::size_t>(statistics.pairs_close), report->pairs().size()});
      contacts = std::max(contacts, report->contacts().size());
      rests += statistics.pairs_tested == 0 ? 1U : 0U;
      std::swap(latest_, report);
      if (random_.chance(0.3)) held_[random_.below(held_count)] = std::move(report);
    }
  }

  // What the scene is to have room for:
  std::size_t near_pairs = 0;
  std::size_t contacts = 0;
  std::size_t rests = 0;

 private:
  struct Body {
    std::shared_ptr<const Mesh> mesh;
    ObjectId id;
    Motion motion;
    Eigen::Vector3d at;
    Positions positions;
  };
  void move(Body& body, double size) {
    body.at += random_.vector(-size, size);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = body.at;
    if (body.motion == Motion::rigid) return scene_.set_pose(body.id, pose);
    body.positions.resize(body.mesh->vertex_count());
    for (std::size_t i = 0; i < body.positions.size(); ++i)
      body.positions[i] = body.mesh->rest()[i] + body.at;
    scene_.set_positions(body.id, body.positions);
  }

  Scene scene_;
  oracle::Random random_;
  std::vector<Body> bodies_;
  ReportHandle latest_;
  std::array<ReportHandle, held_count> held_;
};

}  // namespace

TEST_CASE("allocations of every kind and thread are counted") {
  if (is_skipped()) return;
  const auto counted = [](const auto& allocate) {
    AllocationCount::begin();
    allocate();
    AllocationCount::end();
    return AllocationCount::by_others();
  };
  static void* volatile kept = nullptr;  // or the compiler leaves the allocation out
  const auto keep = [](void* memory) {
    kept = memory;
    std::free(kept);
  };
  CHECK(counted([] {}) == 0);
  CHECK(counted([&] { keep(std::malloc(8)); }) == 1);
  CHECK(counted([&] { keep(std::calloc(8, 8)); }) == 1);
  CHECK(counted([&] { keep(std::realloc(nullptr, 8)); }) == 1);
  CHECK(counted([&] { keep(std::aligned_alloc(64, 64)); }) == 1);
  CHECK(counted([&] { keep(operator new(8)); }) == 1);
  CHECK(counted([&] { keep(operator new(64, std::align_val_t(64))); }) == 1);
  std::atomic<bool> go = false;
  std::thread other([&] {
    while (!go) std::this_thread::yield();
    keep(std::malloc(8));
  });
  const std::uint64_t by_other_thread = counted([&] {
    go = true;
    other.join();
  });
  CHECK(by_other_thread == 1);
  CHECK_FALSE(AllocationCount::first_of_others().empty());
}

TEST_CASE("a thousand frames of a periodic motion take no memory after the first period") {
  if (is_skipped()) return;
  const auto detail = GENERATE(from_range(all_details));
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), threads);
  SceneSettings settings = settings_of(0.05, 0.3, detail);
  settings.threads = threads;
  settings.region_distances = detail == ContactDetail::none ? 500 : 0;
  settings.ways_out = true;
  Bobbing bobbing(settings);
  AllocationCount::begin();
  play(bobbing, 0, period);
  AllocationCount::end();
  CHECK(AllocationCount::by_others() > 0);
  check_play_takes_none(bobbing, period, period + frame_count);
}

TEST_CASE("a large pair takes no memory after the first periods") {
  if (is_skipped()) return;
  const auto detail = GENERATE(ContactDetail::closest, ContactDetail::features, ContactDetail::nearest);
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), threads);
  SceneSettings settings = settings_of(0.02, 0.1, detail);
  settings.threads = threads;
  settings.region_distances = 20'000;
  Scene scene(settings);
  const auto mesh = mesh_of(models::sphere(90, 60));
  REQUIRE(mesh->vertex_count() >= LargePair::least_vertex_count);
  scene.add(mesh, motion_of(Motion::fixed));
  const ObjectId moving = scene.add(mesh, motion_of(Motion::rigid));
  std::size_t least = ~std::size_t{0};
  std::size_t most = 0;
  const auto play_periods = [&](std::size_t count) {
    constexpr std::size_t frames = 6;
    for (std::size_t frame = 0; frame < count * frames; ++frame) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation().x() = 1.97 + 0.01 * static_cast<double>(frame % frames);
      scene.set_pose(moving, pose);
      const ReportHandle report = scene.step();
      least = std::min(least, report->contacts().size());
      most = std::max(most, report->contacts().size());
      if (report->region_distances().empty()) FAIL("no distances of regions");
    }
  };
  play_periods(4);
  AllocationCount::begin();
  play_periods(4);
  AllocationCount::end();
  CHECK(most > least);
  check_none_thrown();
}

TEST_CASE("no allocation: solids that pass through each other") {
  if (is_skipped()) return;
  const auto detail = GENERATE(ContactDetail::none, ContactDetail::nearest);
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), threads);
  SceneSettings settings = settings_of(0.05, 0.1, detail);
  settings.threads = threads;
  settings.ways_out = true;
  Scene scene(settings);
  const auto mesh = mesh_of(models::sphere(24, 16));
  ObjectSettings solid = motion_of(Motion::rigid);
  solid.solid = true;
  std::array<ObjectId, 3> objects{scene.add(mesh, solid), scene.add(mesh, solid), scene.add(mesh, solid)};
  std::size_t crossing = 0;
  const auto play_periods = [&](std::size_t count) {
    constexpr std::size_t frames = 12;
    for (std::size_t frame = 0; frame < count * frames; ++frame) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation().x() = 0.2 * static_cast<double>(frame % frames);
      scene.set_pose(objects[1], pose);
      pose.translation().x() = -pose.translation().x();
      scene.set_pose(objects[2], pose);
      for (const PairReport& pair : scene.step()->pairs())
        crossing += pair.inside == Inside::crossing ? 1U : 0U;
    }
  };
  play_periods(4);
  AllocationCount::begin();
  play_periods(2);
  AllocationCount::end();
  CHECK(crossing > 10);
  check_none_thrown();
}

TEST_CASE("no allocation: groups of faces that are ignored and watched in turn") {
  if (is_skipped()) return;
  const auto detail = GENERATE(ContactDetail::closest, ContactDetail::vertices, ContactDetail::features);
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), threads);
  SceneSettings settings = settings_of(0.125, 0.5, detail);
  settings.threads = threads;
  Scene scene(settings);
  const auto mesh = mesh_of(models::sheet(8, 8, 1, 1));
  ObjectSettings grouped = motion_of(Motion::rigid);
  for (std::uint32_t face = 0; face < mesh->face_count(); ++face)
    grouped.face_groups.push_back(static_cast<std::uint8_t>(face % 3));
  const ObjectId low = scene.add(mesh, grouped);
  const ObjectId high = scene.add(mesh, grouped);
  std::size_t least = ~std::size_t{0};
  std::size_t most = 0;
  const auto play = [&](std::size_t frames) {
    for (std::size_t frame = 0; frame < frames; ++frame) {
      for (std::uint8_t group = 0; group < 3; ++group)
        frame % 4 < 2 ? scene.ignore(low, group, high, 1) : scene.watch(low, group, high, 1);
      scene.set_pose(high, lift_pose(frame % 3 == 0 ? 0.25 : 0.0625));
      const std::size_t contacts = scene.step()->contacts().size();
      least = std::min(least, contacts);
      most = std::max(most, contacts);
    }
  };
  play(60);
  AllocationCount::begin();
  play(60);
  AllocationCount::end();
  CHECK(most > least);
  check_none_thrown();
}

TEST_CASE("no allocation: hidden faces in pairs that come and go") {
  if (is_skipped()) return;
  const auto detail = GENERATE(ContactDetail::closest, ContactDetail::vertices, ContactDetail::nearest);
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), threads);
  SceneSettings settings = settings_of(0.125, 0.5, detail);
  settings.threads = threads;
  Scene scene(settings);
  const auto mesh = mesh_of(models::sheet(8, 8, 1, 1));
  ObjectSettings half_hidden = motion_of(Motion::rigid);
  for (std::uint32_t face = 0; face < mesh->face_count(); ++face)
    half_hidden.face_groups.push_back(static_cast<std::uint8_t>(face / 32));
  half_hidden.hidden_groups = {1};
  (void)scene.add(mesh, half_hidden);
  const ObjectId high = scene.add(mesh, half_hidden);
  const ObjectId plain = scene.add(mesh, motion_of(Motion::rigid));
  std::size_t contacts = 0;
  const auto play = [&](std::size_t frames) {
    for (std::size_t frame = 0; frame < frames; ++frame) {
      scene.set_pose(high, lift_pose(frame % 3 == 0 ? 2 : 0.0625));
      scene.set_pose(plain, lift_pose(frame % 4 == 0 ? -3 : -0.0625));
      contacts += scene.step()->contacts().size();
    }
  };
  play(60);
  AllocationCount::begin();
  play(60);
  AllocationCount::end();
  CHECK(contacts > 100);
  check_none_thrown();
}

TEST_CASE("a reader that holds eight reports at random makes no step take memory") {
  if (is_skipped()) return;
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(threads);
  SceneSettings settings = settings_of(0.05, 0.3, ContactDetail::features);
  settings.threads = threads;
  Bobbing bobbing(settings);
  bobbing.scene().reserve({.reports = Reader::most_held + 3});
  play(bobbing, 0, 2 * period);
  Reader reader(bobbing.scene());
  reader.wait_for(Reader::capacity);
  const std::size_t taken = reader.taken();
  AllocationCount::begin();
  const Played played = play(bobbing, 2 * period, 2 * period + fewer_frames);
  AllocationCount::end();
  reader.end();
  CHECK(played.idle == 0);
  CHECK(played.diagnostics == 0);
  CHECK(reader.taken() > taken + Reader::capacity);
  CHECK(reader.longest() > 10);
  CHECK(reader.wrong() == 0);
  check_none_thrown();
}

TEST_CASE("a budget takes no memory after the first period") {
  if (is_skipped()) return;
  const auto threads = GENERATE(1U, 2U);
  const bool by_time = GENERATE(true, false);
  CAPTURE(threads, by_time);
  SceneSettings settings = settings_of(0.05, 0.3, ContactDetail::features);
  settings.threads = threads;
  Bobbing unlimited(settings);
  play(unlimited, 0, period);
  const ReportHandle report = unlimited.step(period);
  const StepStatistics& work = report->statistics();
  // About half of what a step needs.
  if (by_time)
    settings.time_budget = std::chrono::microseconds(static_cast<std::int64_t>(
        500 * (work.times.read_ms + work.times.pairs_ms + work.times.refit_ms + work.times.jobs_ms)));
  else
    settings.work_budget = work.work.region_pairs_tested / 2;
  Bobbing bobbing(settings);
  // How far a budget in time lasts is chance: room is made for all.
  bobbing.scene().reserve({.near_pairs = 400, .contacts = 40'000, .reports = 3});
  play(bobbing, 0, 2 * period);
  AllocationCount::begin();
  const Played played = play(bobbing, 2 * period, 2 * period + fewer_frames);
  AllocationCount::end();
  CHECK(played.diagnostics == 0);
  CHECK(played.incomplete > 0);
  check_none();
  // A search whose time is up ends by an exception, for which the language takes some hundred bytes for a
  // moment.
  CHECK(AllocationCount::by_exceptions() <= (by_time ? threads * fewer_frames : 0));
}

TEST_CASE("step_async and wait take no memory after the first period") {
  if (is_skipped()) return;
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(threads);
  SceneSettings settings = settings_of(0.05, 0.3, ContactDetail::features);
  settings.threads = threads;
  Bobbing bobbing(settings);
  play(bobbing, 0, 2 * period, Stepping::step_async);
  check_play_takes_none(bobbing, 2 * period, 2 * period + fewer_frames, Stepping::step_async);
}

TEST_CASE("first contacts take no memory where room was reserved") {
  if (is_skipped()) return;
  const auto detail = GENERATE(from_range(all_details));
  const auto threads = GENERATE(1U, 2U);
  const bool is_reserved = GENERATE(true, false);
  CAPTURE(static_cast<int>(detail), threads, is_reserved);
  SceneSettings settings = settings_of(0.05, 0.3, detail);
  settings.threads = threads;
  settings.region_distances = 500;
  settings.ways_out = true;
  Falling falling(settings);
  if (is_reserved) falling.scene().reserve({.near_pairs = 64, .contacts = 5'000, .reports = 4});
  for (std::size_t frame = 0; frame < Falling::frames_aloft; ++frame)
    CHECK(falling.step(frame)->statistics().pairs_tested == 0);
  std::array<ReportHandle, 4> held;
  std::size_t touching = 0;
  AllocationCount::begin();
  for (std::size_t frame = Falling::frames_aloft; frame < Falling::frames_aloft + 60; ++frame) {
    held[frame % held.size()] = falling.step(frame);
    touching = std::max(touching, held[frame % held.size()]->statistics().pairs_in_contact);
  }
  AllocationCount::end();
  CHECK(touching > Falling::drops / 2);
  if (is_reserved)
    check_none_thrown();
  else
    CHECK(AllocationCount::by_others() > 50);
}

TEST_CASE("no allocation: bodies that tremble within the bounds that were reserved") {
  if (is_skipped()) return;
  const auto detail =
      GENERATE(ContactDetail::none, ContactDetail::closest, ContactDetail::features, ContactDetail::nearest);
  const auto limit = GENERATE(0, 1, 2, 3);
  if (limit == 3 && detail != ContactDetail::nearest) return;
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), limit, threads);
  constexpr std::size_t frames = 150;
  SceneSettings settings = settings_of(0.06, 0.2, detail);
  settings.threads = threads;
  settings.ways_out = true;
  if (limit == 1) settings.max_contacts = 60;
  if (limit == 2) settings.max_contacts_per_pair = 9;
  if (limit == 3) settings.carrying = 4;
  const auto seed = static_cast<std::uint64_t>(limit);
  Trembling first(settings, seed);
  first.play(0, frames);
  if (limit != 1) REQUIRE(first.rests > frames / 3);  // pairs that are cut by it are tested in every step
  SceneSettings unlimited = settings;
  unlimited.max_contacts = unlimited.max_contacts_per_pair = std::nullopt;
  unlimited.carrying = 0;
  Trembling all(unlimited, seed);  // what a limit leaves out needs room, too
  all.play(0, frames);
  Trembling again(settings, seed);
  again.scene().reserve({.objects = 9,
                         .calls_per_step = 9,
                         .near_pairs = first.near_pairs,
                         .contacts = all.contacts,
                         .reports = Trembling::held_count});
  again.play(0, Trembling::first_frames);
  AllocationCount::begin();
  again.play(Trembling::first_frames, frames);
  AllocationCount::end();
  check_none_thrown();
}

TEST_CASE("no allocation: a step that is recorded, while the writer follows") {
  if (is_skipped()) return;
  SceneSettings settings = settings_of(0.125, 0.5);
  settings.threads = 1;
  Bobbing bobbing(settings);
  const TemporaryFolder folder;
  Recorder recorder(bobbing.scene(), folder / "run.graze", {.keyframe_interval = 16, .waiting_frames = 2});
  std::size_t contacts = 0;
  const auto play_recorded = [&](std::size_t begin, std::size_t end) {
    for (std::size_t frame = begin; frame < end; ++frame) {
      bobbing.tell(frame);
      contacts += bobbing.scene().step()->contacts().size();
      while (recorder.statistics().frames <= frame) std::this_thread::yield();
    }
  };
  play_recorded(0, 3 * period);
  AllocationCount::begin_of_this_thread();
  play_recorded(3 * period, fewer_frames);
  AllocationCount::end();
  check_none_thrown();
  CHECK(contacts > 0);
  recorder.close();
  CHECK(recorder.statistics().dropped == 0);
}

}  // namespace graze::tests
