// Writers, a stepping thread and readers at once: every report is whole, and nothing said is lost.

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <atomic>
#include <thread>

#include "scenes/report_hash.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// One writer, which adds, moves, removes and filters objects of its own. At the end one object of its own is
/// left in the scene.
class Writer {
 public:
  Writer(Scene& scene, std::uint64_t seed) : scene_(scene), random_(seed) {}

  void run(int operations) {
    for (int i = 0; i < operations; ++i) act();
    while (own_.size() > 1) remove_last();
    if (own_.empty()) add();
    place(own_[0], 0.25);
  }
  [[nodiscard]] ObjectId left() const { return own_[0].id; }
  [[nodiscard]] std::uint64_t stale_calls() const { return stale_calls_; }

 private:
  struct Own {
    ObjectId id;
    Motion motion;
  };

  void add() {
    const Motion motion = random_.chance(0.5) ? Motion::rigid : Motion::deformable;
    own_.push_back({scene_.add(mesh_, motion_of(motion)), motion});
  }
  void remove_last() {
    scene_.remove(own_.back().id);
    gone_ = own_.back().id;
    own_.pop_back();
  }
  void place(const Own& object, double height) {
    if (object.motion == Motion::rigid)
      scene_.set_pose(object.id, lift_pose(height));
    else
      scene_.set_positions(object.id, lifted(*mesh_, height));
  }
  void act() {
    const std::uint32_t what = random_.below(8);
    if (own_.empty() || (what == 0 && own_.size() < 4)) return add();
    const Own& object = own_[random_.below(static_cast<std::uint32_t>(own_.size()))];
    if (what == 1) return remove_last();
    if (what == 2 && gone_ != ObjectId{}) {
      ++stale_calls_;
      return scene_.set_pose(gone_, lift_pose(1));
    }
    if (what == 3) return scene_.ignore(object.id, own_.back().id == object.id ? ObjectId{} : own_.back().id);
    if (what == 4) return scene_.watch(object.id, own_.front().id);
    if (what == 5) return scene_.set_rule(1, 2, {random_.between(0, 1), 1, {}});
    place(object, random_.between(-1, 3));
  }

  Scene& scene_;
  oracle::Random random_;
  std::shared_ptr<const Mesh> mesh_ = needle_mesh();
  std::vector<Own> own_;
  ObjectId gone_;
  std::uint64_t stale_calls_ = 0;
};

/// A reader sees whole reports whose frames never go back.
std::size_t problems_seen_by_reader(const Scene& scene, const std::atomic<bool>& done) {
  std::size_t problems = 0;
  std::uint64_t last = 0;
  std::vector<ReportHandle> kept;
  while (!done) {
    const ReportHandle report = scene.latest_report();
    if (!inconsistency_of(*report).empty() || report->frame() < last) ++problems;
    last = report->frame();
    kept.push_back(report);
    if (kept.size() > 20) kept.erase(kept.begin(), kept.begin() + 10);
  }
  return problems;
}

/// A scene that four threads write to, one steps and two read, all at once.
struct BusyScene {
  static constexpr int writer_count = 4;

  explicit BusyScene(unsigned threads, std::uint64_t first_seed)
      : scene(settings_with(threads)), plate(scene.add(plate_mesh())) {
    for (std::uint64_t i = 0; i < writer_count; ++i) writers.emplace_back(scene, first_seed + i);
  }

  /// Until every writer has made so many calls. Asserts nothing, so that it can run on any thread.
  void run(int operations) {
    std::atomic<bool> done = false;
    std::atomic<int> writing = writer_count;
    std::vector<std::thread> threads;
    for (std::size_t& problems : reader_problems)
      threads.emplace_back([&] { problems = problems_seen_by_reader(scene, done); });
    for (Writer& writer : writers)
      threads.emplace_back([&] {
        writer.run(operations);
        --writing;
      });
    for (bool last = false; !last; ++steps) {
      last = writing == 0;
      const ReportHandle report = scene.step();
      if (!inconsistency_of(*report).empty() || report->frame() != steps + 1) ++step_problems;
      for (const Diagnostic& diagnostic : report->diagnostics())
        if (diagnostic.kind == DiagnosticKind::stale_id && diagnostic.message.find("set_pose") == 0) ++stale;
    }
    done = true;
    for (std::thread& thread : threads) thread.join();
  }

  /// Each writer's last word holds, and each of its mistakes was said once.
  void check() {
    CHECK(step_problems == 0);
    CHECK(reader_problems == std::array<std::size_t, 2>{});
    CHECK(scene.object_count() == 1 + writer_count);
    const ReportHandle report = scene.step();
    std::uint64_t expected_stale = 0;
    for (const Writer& writer : writers) {
      expected_stale += writer.stale_calls();
      const PairReport* const pair = find_pair(*report, plate, writer.left());
      REQUIRE(pair != nullptr);
      CHECK(pair->distance.upper == 0.25);
      CHECK(pair->phase == PairPhase::touching);
    }
    CHECK(stale == expected_stale);
    CHECK(expected_stale > 0);
  }

  static SceneSettings settings_with(unsigned threads) {
    SceneSettings settings = settings_of(0.5, 1);
    settings.threads = threads;
    return settings;
  }

  Scene scene;
  ObjectId plate;
  std::vector<Writer> writers;
  std::array<std::size_t, 2> reader_problems{};
  std::size_t step_problems = 0;
  std::uint64_t steps = 0, stale = 0;
};

/// A scene of five tori in a row that bend, and all that its reports say in so many frames.
std::uint64_t hash_of_bending_tori(unsigned threads, std::size_t frames,
                                   const std::shared_ptr<const Mesh>& torus) {
  Scene scene(BusyScene::settings_with(threads));
  std::vector<ObjectId> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(scene.add(torus));
  scenes::ReportHash hash;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Positions positions(torus->rest().begin(), torus->rest().end());
      for (Eigen::Vector3d& point : positions)
        point.z() += static_cast<double>(i) + 0.0625 * static_cast<double>(frame % 8) * point.x() * point.y();
      scene.set_positions(ids[i], positions);
    }
    hash.add(*scene.step());
  }
  return hash.value();
}

/// Two balls of which each is read and refitted in parts, and whose search is cut into slices. They wobble
/// and come to touch.
std::uint64_t hash_of_large_pair(ContactDetail detail, unsigned threads, std::size_t frames,
                                 const std::shared_ptr<const Mesh>& ball) {
  SceneSettings settings = settings_of(0.02, 1);
  settings.detail = detail;
  settings.threads = threads;
  settings.region_distances = 5000;
  Scene scene(settings);
  const std::array<ObjectId, 2> ids{scene.add(ball), scene.add(ball)};
  scenes::ReportHash hash;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Positions positions(ball->rest().begin(), ball->rest().end());
      for (Eigen::Vector3d& point : positions) {
        point *= 1 + 0.0078125 * point.x() * point.y() * static_cast<double>(frame % 4);
        point.z() += static_cast<double>(i) * (2.03125 - 0.015625 * static_cast<double>(frame));
      }
      scene.set_positions(ids[i], positions);
    }
    const ReportHandle report = scene.step();
    CHECK(report->pairs().size() == 1);
    hash.add(*report);
  }
  return hash.value();
}

}  // namespace

TEST_CASE("threads: four write, one steps and two read") {
  BusyScene busy(2, 0);
  busy.run(500);
  busy.check();
}

TEST_CASE("threads: two scenes at once, each with four that write, one that steps and two that read") {
  BusyScene first(2, 10);
  BusyScene second(3, 20);
  std::thread other([&] { second.run(5000); });
  first.run(5000);
  other.join();
  first.check();
  second.check();
}

TEST_CASE("threads: a scene with one thread is written to and read by six others") {
  BusyScene busy(1, 30);
  busy.run(2000);
  busy.check();
}

TEST_CASE("threads: scenes stepped from the tasks of a caller's own parallel loop") {
  const auto torus = mesh_of(models::torus(6, 4, 1, 0.25));
  constexpr std::size_t frames = 5;
  const std::uint64_t alone = hash_of_bending_tori(1, frames, torus);
  for (const unsigned threads : {1U, 2U, 4U}) {
    std::array<std::uint64_t, 16> hashes{};
    oneapi::tbb::parallel_for(std::size_t{0}, hashes.size(), [&](std::size_t index) {
      hashes[index] = hash_of_bending_tori(threads, frames, torus);
    });
    for (const std::uint64_t hash : hashes) CHECK(hash == alone);
  }
}

TEST_CASE("threads: one large pair is worked on by all of them") {
  const auto ball = mesh_of(models::sphere(120, 80));
  REQUIRE(ball->vertex_count() > 8192);
  for (const ContactDetail detail : {ContactDetail::features, ContactDetail::vertices, ContactDetail::closest,
                                     ContactDetail::none, ContactDetail::nearest}) {
    const std::uint64_t alone = hash_of_large_pair(detail, 1, 4, ball);
    for (const unsigned threads : {2U, 4U}) CHECK(hash_of_large_pair(detail, threads, 4, ball) == alone);
  }
}

TEST_CASE("threads: inside an arena of one") {
  const auto torus = mesh_of(models::torus(6, 4, 1, 0.25));
  const std::uint64_t alone = hash_of_bending_tori(1, 10, torus);
  std::uint64_t found = 0;
  oneapi::tbb::task_arena arena(1);
  arena.execute([&] { found = hash_of_bending_tori(4, 10, torus); });
  CHECK(found == alone);
}

TEST_CASE("threads: a second step at the same time is refused, and the first goes on") {
  Scene scene(BusyScene::settings_with(2));
  const auto torus = mesh_of(models::torus(6, 4, 1, 0.25));
  for (int i = 0; i < 10; ++i) scene.set_positions(scene.add(torus), lifted(*torus, 0.25 * i));
  constexpr int tries = 100;
  std::atomic<int> stepped = 0;
  std::atomic<int> refused = 0;
  const auto step = [&] {
    for (int i = 0; i < tries; ++i) {
      try {
        scene.step();
        ++stepped;
      } catch (const Error&) {
        ++refused;
      }
    }
  };
  std::thread other(step);
  step();
  other.join();
  CHECK(stepped + refused == 2 * tries);
  CHECK(scene.latest_report()->frame() == static_cast<std::uint64_t>(stepped));
}

TEST_CASE("threads: calls of one thread during a step are taken up whole by the next") {
  SceneSettings settings = settings_of(0.5, 100);
  settings.threads = 2;
  NeedleOverPlate pair(settings);
  std::atomic<bool> done = false;
  // All three vertices are always lifted by the same amount: a torn read would tilt the needle.
  std::thread writer([&] {
    for (int i = 0; i < 2000; ++i) pair.lift(i % 50);
    done = true;
  });
  while (!done) {
    const ReportHandle report = pair.scene.step();
    const PairReport& row = only_pair(*report);
    REQUIRE(row.witness.point_b.z() == std::floor(row.witness.point_b.z()));
    REQUIRE(row.witness.point_b.x() == 0.25);
    REQUIRE(row.distance.upper == row.witness.point_b.z());
  }
  writer.join();
  CHECK(only_pair(*pair.scene.step()).distance.upper == 49);
}

}  // namespace graze::tests
