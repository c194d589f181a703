// Calls for many objects mean the same as single calls one after the other, and are taken up whole. Also what
// they cost.

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <thread>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t object_count = 12;

/// Needles above a plate, half of them deformable, the others rigid, told what to do object by object or all
/// at once.
class Needles {
 public:
  explicit Needles(bool in_batches) : scene(settings_of(0.25, 1)), in_batches_(in_batches) {
    scene.add(plate_mesh());
    for (std::size_t i = 0; i < object_count; ++i)
      ids.push_back(scene.add(needle_mesh(), motion_of(i % 2 == 0 ? Motion::deformable : Motion::rigid)));
    ids.push_back({77, 1});
  }

  void set_poses(const std::vector<Eigen::Isometry3d>& poses) {
    if (in_batches_) return scene.set_poses(ids, poses);
    for (std::size_t i = 0; i < ids.size(); ++i) scene.set_pose(ids[i], poses[i]);
  }
  void set_positions(const std::vector<PositionView>& views, double promise) {
    if (in_batches_) return scene.set_positions(ids, views, promise);
    for (std::size_t i = 0; i < ids.size(); ++i) scene.set_positions(ids[i], views[i], promise);
  }
  void bind_positions(const std::vector<PositionView>& views, BindPolicy policy) {
    if (in_batches_) return scene.bind_positions(ids, views, policy);
    for (std::size_t i = 0; i < ids.size(); ++i) scene.bind_positions(ids[i], views[i], policy);
  }
  void positions_changed(double promise) {
    if (in_batches_) return scene.positions_changed(ids, promise);
    for (const ObjectId id : ids) scene.positions_changed(id, promise);
  }
  void positions_changed(const std::vector<double>& promises) {
    if (in_batches_) return scene.positions_changed(ids, promises);
    for (std::size_t i = 0; i < ids.size(); ++i) scene.positions_changed(ids[i], promises[i]);
  }

  Scene scene;
  std::vector<ObjectId> ids;  ///< of the needles, and one that names nothing

 private:
  bool in_batches_;
};

/// Nanoseconds of the fastest of some calls.
double fastest(const std::function<void()>& call) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 20; ++repeat) {
    const auto start = Clock::now();
    call();
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  return best;
}

}  // namespace

TEST_CASE("calls for many objects mean the same as single calls, diagnostics included") {
  Needles single(false);
  Needles batched(true);
  oracle::Random random(11);
  std::vector<Positions> memory(object_count + 1, lifted(*needle_mesh(), 0));
  const std::vector<PositionView> views(memory.begin(), memory.end());
  for (int step = 0; step < 200; ++step) {
    for (Positions& positions : memory) {
      const Positions now = moved(needle_mesh()->rest(), {random.between(-1, 1), 0, random.between(-0.5, 1)});
      std::copy(now.begin(), now.end(), positions.begin());
    }
    std::vector<Eigen::Isometry3d> poses;
    std::vector<double> promises;
    for (std::size_t i = 0; i <= object_count; ++i) {
      poses.push_back(lift_pose(random.between(-0.5, 1)));
      if (random.chance(0.1)) poses[i].linear() *= 2;
      promises.push_back(random.between(-0.5, 4));
    }
    const double promise = random.between(0, 2);
    const std::uint32_t what = random.below(5);
    for (Needles* const needles : {&single, &batched}) {
      if (what == 0) needles->set_poses(poses);
      if (what == 1) needles->set_positions(views, promise);
      if (what == 2)
        needles->bind_positions(views, promise < 1 ? BindPolicy::when_told : BindPolicy::every_step);
      if (what == 3) needles->positions_changed(promise);
      if (what == 4) needles->positions_changed(promises);
    }
    const ReportHandle left = single.scene.step();
    const ReportHandle right = batched.scene.step();
    REQUIRE(difference_of(*left, *right) == "");
    REQUIRE(left->diagnostics().size() > object_count / 2);  // half of them cannot be moved that way
  }
}

TEST_CASE("spans that do not fit together are a diagnostic and nothing is taken") {
  NeedleOverPlate pair(settings_of(0.5, 10));
  const std::array ids = {pair.plate, pair.needle};
  const std::vector<PositionView> one_view = {needle_mesh()->rest()};
  const std::vector<Eigen::Isometry3d> poses(3, lift_pose(2));
  const std::vector<double> promises(1, 0.0);
  pair.lift(1);
  pair.scene.set_poses(ids, poses);
  pair.scene.set_poses(ids, {});
  pair.scene.set_positions(ids, one_view);
  pair.scene.bind_positions(ids, one_view);
  pair.scene.positions_changed(ids, promises);
  const ReportHandle report = pair.scene.step();
  CHECK(kinds_of(*report) == std::vector(5, DiagnosticKind::wrong_count));
  for (const Diagnostic& diagnostic : report->diagnostics()) CHECK(diagnostic.object == ObjectId{});
  CHECK(only_pair(*report).distance.upper == 1);

  const std::span<const ObjectId> none;
  pair.scene.set_poses(none, {});
  pair.scene.set_positions(none, {});
  pair.scene.bind_positions(none, {});
  pair.scene.positions_changed(none);
  CHECK(pair.scene.step()->diagnostics().empty());
}

TEST_CASE("one step takes up all of a batch from another thread") {
  SceneSettings settings = settings_of(0, 1000, ContactDetail::none);
  settings.threads = 2;
  Scene scene(settings);
  std::vector<ObjectId> ids;
  for (int i = 0; i < 50; ++i) ids.push_back(scene.add(needle_mesh(), motion_of(Motion::rigid)));
  const ObjectId plate = scene.add(plate_mesh());
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int height = 1; height <= 1000; ++height)
      scene.set_poses(ids, std::vector<Eigen::Isometry3d>(ids.size(), lift_pose(height % 100)));
    done = true;
  });
  std::size_t torn = 0;
  while (!done) {
    const ReportHandle report = scene.step();
    const double height = report->pairs().back().distance.upper;
    for (const ObjectId id : ids)
      if (find_pair(*report, id, plate)->distance.upper != height) ++torn;
  }
  writer.join();
  CHECK(torn == 0);
  CHECK(find_pair(*scene.step(), ids[0], plate)->distance.upper == 0);
}

TEST_CASE("what is told of ten thousand objects costs nanoseconds an object") {
  constexpr std::size_t count = 10000;
  Scene scene(settings_of(0, 0, ContactDetail::none));
  std::vector<ObjectId> rigid;
  std::vector<ObjectId> bound;
  std::vector<PositionView> views;
  const auto mesh = needle_mesh();
  for (std::size_t i = 0; i < count; ++i) {
    rigid.push_back(scene.add(mesh, motion_of(Motion::rigid)));
    bound.push_back(scene.add(mesh));
    views.emplace_back(mesh->rest());
  }
  const std::vector<Eigen::Isometry3d> poses(count, lift_pose(1));
  std::vector<Eigen::Isometry3d> copy(count);
  scene.reserve({.objects = 2 * count, .calls_per_step = 200 * count});

  const double copied = fastest([&] { std::memcpy(copy.data()->data(), poses.data()->data(), 128 * count); });
  CHECK(copy.back().matrix() == poses.back().matrix());
  const auto line = [&](const char* what, double nanoseconds) {
    std::cout << what << ": " << nanoseconds / count << " ns an object\n";
    // Generous: the machine may be busy, and sanitizers look at each access.
    CHECK(nanoseconds / count < 20000);
  };
  line("a copy of the poses", copied);
  line("set_pose", fastest([&] {
         for (std::size_t i = 0; i < count; ++i) scene.set_pose(rigid[i], poses[i]);
       }));
  line("set_poses", fastest([&] { scene.set_poses(rigid, poses); }));
  line("positions_changed", fastest([&] {
         for (const ObjectId id : bound) scene.positions_changed(id, 1);
       }));
  line("positions_changed of many", fastest([&] { scene.positions_changed(bound, 1); }));
  line("bind_positions of many", fastest([&] { scene.bind_positions(bound, views); }));
}

}  // namespace graze::tests
