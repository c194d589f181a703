// Writers, a stepping thread and readers at once: every report is whole, and nothing said is lost.

#include <atomic>
#include <thread>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

/// What one writer does to objects of its own: comes, moves, goes, filters. Leaves its last object in place.
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

}  // namespace

TEST_CASE("four threads write, one steps and two read") {
  constexpr int writer_count = 4;
  constexpr int operations = 500;
  SceneSettings settings = settings_of(0.5, 1);
  settings.threads = 2;
  Scene scene(settings);
  const ObjectId plate = scene.add(plate_mesh());
  std::vector<Writer> writers;
  for (std::uint64_t seed = 0; seed < writer_count; ++seed) writers.emplace_back(scene, seed);

  std::atomic<bool> done = false;
  std::atomic<int> writing = writer_count;
  std::array<std::size_t, 2> reader_problems{};
  std::size_t step_problems = 0;
  std::uint64_t stale = 0;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < reader_problems.size(); ++i)
    threads.emplace_back([&, i] { reader_problems[i] = problems_seen_by_reader(scene, done); });
  for (Writer& writer : writers)
    threads.emplace_back([&] {
      writer.run(operations);
      --writing;
    });
  std::uint64_t steps = 0;
  for (bool last = false; !last; ++steps) {
    last = writing == 0;
    const ReportHandle report = scene.step();
    if (!inconsistency_of(*report).empty() || report->frame() != steps + 1) ++step_problems;
    for (const Diagnostic& diagnostic : report->diagnostics())
      if (diagnostic.kind == DiagnosticKind::stale_id && diagnostic.message.find("set_pose") == 0) ++stale;
  }
  done = true;
  for (std::thread& thread : threads) thread.join();
  CHECK(step_problems == 0);
  CHECK(reader_problems == std::array<std::size_t, 2>{});

  // Each writer's last word holds, and each of its mistakes was said once.
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

TEST_CASE("calls of one thread during a step are taken up whole by the next") {
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
