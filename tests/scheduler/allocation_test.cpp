// After one period of a periodic motion no step and no call around it takes memory, whatever the detail and
// the number of threads: a thousand frames, in each of which pairs begin and end.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <new>
#include <numbers>
#include <thread>

#include "scheduler/allocation_count.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t period = 20;
constexpr std::size_t frame_count = 1000;
constexpr double furthest_move = 0.1;  ///< between two frames

std::shared_ptr<const Mesh> drop_mesh() {
  models::MeshData sphere = models::sphere(8, 5);
  for (Eigen::Vector3d& position : sphere.positions) position *= 0.15;
  return mesh_of(sphere);
}

/// A plate over which drops bob up and down, each one frame later than the one before: in every frame one
/// comes to touch the plate and one leaves it. They are moved in every way there is, by single calls and in
/// batches, and every pair is filtered out now and then. All that is told was calculated before.
class Bobbing {
 public:
  explicit Bobbing(const SceneSettings& settings) : scene_(settings), mesh_(drop_mesh()) {
    plate_ = scene_.add(mesh_of(models::sheet(16, 16, 4, 4)), motion_of(Motion::fixed));
    for (std::size_t drop = 0; drop < period; ++drop) {
      const Given given = given_of(drop);
      ids_[drop] = scene_.add(mesh_, motion_of(given == Given::posed ? Motion::rigid : Motion::deformable));
      of_[static_cast<std::size_t>(given)].push_back(drop);
      for (std::size_t frame = 0; frame < period; ++frame) {
        poses_[frame].push_back(pose(drop, frame));
        positions_[frame].push_back(moved(mesh_->rest(), poses_[frame][drop].translation()));
      }
      own_.push_back(positions_[0][drop]);
      if (given == Given::told) scene_.bind_positions(ids_[drop], own_[drop], BindPolicy::when_told);
    }
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }

  ReportHandle step(std::size_t frame) {
    copy(frame % period);
    bind(frame % period);
    tell(frame % period);
    place(frame % period);
    scene_.watch(plate_, ids_[frame % period]);
    scene_.ignore(ids_[(frame + 1) % period], plate_);
    return scene_.step();
  }

 private:
  enum class Given { copied, bound, told, posed };
  static Given given_of(std::size_t drop) { return static_cast<Given>(drop % 4); }
  static Eigen::Isometry3d pose(std::size_t drop, std::size_t frame) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>((drop + frame) % period) / static_cast<double>(period);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() =
        Eigen::Vector3d(0.5 * static_cast<double>(drop % 5) - 1, 0.5 * static_cast<double>(drop / 5) - 1,
                        0.3 + 0.3 * std::sin(angle));
    return pose;
  }
  [[nodiscard]] const std::vector<std::size_t>& all(Given given) const {
    return of_[static_cast<std::size_t>(given)];
  }

  /// What a batch says of the drops that are given in one way, from the second on; the first goes by itself.
  struct Batch {
    std::array<ObjectId, period> ids;
    std::array<PositionView, period> views;
    std::array<double, period> promises;
    std::array<Eigen::Isometry3d, period> poses;
    std::size_t size = 0;
  };
  Batch batch_of(Given given, std::size_t frame) const {
    Batch batch;
    for (const std::size_t drop : all(given)) {
      if (drop == all(given)[0]) continue;
      batch.ids[batch.size] = ids_[drop];
      batch.views[batch.size] = positions_[frame][drop];
      batch.promises[batch.size] = furthest_move;
      batch.poses[batch.size] = poses_[frame][drop];
      ++batch.size;
    }
    return batch;
  }
  template <typename Thing>
  static std::span<const Thing> first(const std::array<Thing, period>& things, const Batch& batch) {
    return std::span<const Thing>(things).first(batch.size);
  }

  void copy(std::size_t frame) {
    const std::size_t single = all(Given::copied)[0];
    scene_.set_positions(ids_[single], positions_[0][single]);  // the later call counts
    scene_.set_positions(ids_[single], positions_[frame][single]);
    const Batch batch = batch_of(Given::copied, frame);
    scene_.set_positions(first(batch.ids, batch), first(batch.views, batch));
  }
  void bind(std::size_t frame) {
    const std::size_t single = all(Given::bound)[0];
    scene_.unbind_positions(ids_[single]);
    scene_.bind_positions(ids_[single], positions_[frame][single]);
    const Batch batch = batch_of(Given::bound, frame);
    scene_.bind_positions(first(batch.ids, batch), first(batch.views, batch));
  }
  void tell(std::size_t frame) {
    for (const std::size_t drop : all(Given::told)) own_[drop] = positions_[frame][drop];
    scene_.positions_changed(ids_[all(Given::told)[0]]);
    const Batch batch = batch_of(Given::told, frame);
    scene_.positions_changed(first(batch.ids, batch));
    scene_.positions_changed(first(batch.ids, batch), first(batch.promises, batch));
  }
  void place(std::size_t frame) {
    const std::size_t single = all(Given::posed)[0];
    scene_.set_pose(ids_[single], poses_[frame][single]);
    const Batch batch = batch_of(Given::posed, frame);
    scene_.set_poses(first(batch.ids, batch), first(batch.poses, batch));
  }

  Scene scene_;
  std::shared_ptr<const Mesh> mesh_;
  ObjectId plate_;
  std::array<ObjectId, period> ids_;
  std::array<std::vector<std::size_t>, 4> of_;  ///< the drops given in each way
  std::array<std::vector<Eigen::Isometry3d>, period> poses_;
  std::array<std::vector<Positions>, period> positions_;
  std::vector<Positions> own_;  ///< bound, and read when told
};

std::size_t count_of(const FrameReport& report, PairPhase phase) {
  return static_cast<std::size_t>(std::count_if(report.pairs().begin(), report.pairs().end(),
                                                [&](const PairReport& pair) { return pair.phase == phase; }));
}

/// Of the frames from `begin` to `end` those in which no pair begins or none ends, or something was wrong.
std::size_t idle_frames(Bobbing& bobbing, std::size_t begin, std::size_t end) {
  std::array<ReportHandle, 3> held;
  std::size_t idle = 0;
  for (std::size_t frame = begin; frame < end; ++frame) {
    ReportHandle& report = held[frame % held.size()];
    report = bobbing.step(frame);
    const bool busy = count_of(*report, PairPhase::began) > 0 && count_of(*report, PairPhase::ended) > 0;
    if (!busy || !report->diagnostics().empty()) ++idle;
  }
  return idle;
}

}  // namespace

TEST_CASE("allocations of every kind and thread are counted") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
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
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto detail = GENERATE(ContactDetail::none, ContactDetail::closest, ContactDetail::regions,
                               ContactDetail::vertices, ContactDetail::features);
  const auto threads = GENERATE(1U, 2U);
  CAPTURE(static_cast<int>(detail), threads);
  SceneSettings settings = settings_of(0.05, 0.3, detail);
  settings.threads = threads;
  Bobbing bobbing(settings);
  idle_frames(bobbing, 0, period);
  AllocationCount::begin();
  const std::size_t idle = idle_frames(bobbing, period, period + frame_count);
  AllocationCount::end();
  CHECK(idle == 0);
  INFO(AllocationCount::first_of_others());
  CHECK(AllocationCount::by_tbb() == 0);
  CHECK(AllocationCount::by_others() == 0);
}

}  // namespace graze::tests
