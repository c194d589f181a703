// Steps in which nothing has changed: their reports show the rows of the report before.

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

bool shares_rows(const ReportHandle& left, const ReportHandle& right) {
  return left->pairs().data() == right->pairs().data();
}

/// Two scenes of a plate and a needle that are told to do the same. In the second scene another needle, far
/// away, never rests. So every step of that scene has a change.
class RestingAndNot {
 public:
  explicit RestingAndNot(const SceneSettings& settings)
      : resting_(settings), disturbed_(settings), far_(disturbed_.scene.add(needle_mesh())) {}

  template <typename Tell>
  void tell(const Tell& tell) {
    tell(resting_);
    tell(disturbed_);
  }
  /// Steps both. Returns the report of the one that may rest.
  ReportHandle step() {
    far_height_ = far_height_ == 1000 ? 1001 : 1000;
    disturbed_.scene.set_positions(far_, lifted(*needle_mesh(), far_height_));
    const ReportHandle other = disturbed_.scene.step();
    const ReportHandle report = resting_.scene.step();
    INFO("frame " << report->frame());
    CHECK(difference_of(*report, *other) == "");
    CHECK(report->statistics().pairs_near == other->statistics().pairs_near);
    CHECK(report->statistics().pairs_in_contact == other->statistics().pairs_in_contact);
    CHECK(report->statistics().pairs_unchanged == other->statistics().pairs_unchanged);
    CHECK(report->statistics().pairs_tested == other->statistics().pairs_tested);
    CHECK(report->statistics().contacts == other->statistics().contacts);
    return report;
  }

 private:
  NeedleOverPlate resting_;
  NeedleOverPlate disturbed_;
  ObjectId far_;
  double far_height_ = 1000;
};

/// Small bodies in a heap, in two scenes that are told the same. But one is also given a rule about kinds
/// that no object has before every step, so that no pair of it rests.
class Heap {
 public:
  Heap(const SceneSettings& settings, std::uint64_t seed)
      : random_(seed), scenes_{Scene(settings), Scene(settings)} {
    while (bodies_.size() < 40) add();
  }

  /// Something happens to a few bodies.
  void happen() {
    for (Body& body : bodies_) body.touched = false;
    rules_changed_ = false;
    for (std::uint32_t count = random_.below(4); count > 0; --count) {
      Body& body = bodies_[random_.below(static_cast<std::uint32_t>(bodies_.size()))];
      Body& other = bodies_[random_.below(static_cast<std::uint32_t>(bodies_.size()))];
      body.touched = true;
      switch (random_.below(12)) {
        case 0:
          for (const std::size_t k : {0U, 1U}) scenes_[k].remove(body.ids[k]);
          body = std::move(bodies_.back());
          bodies_.pop_back();
          break;
        case 1:
          add();
          break;
        case 2:
          for (const std::size_t k : {0U, 1U}) scenes_[k].ignore(body.ids[k], other.ids[k]);
          break;
        case 3:
          for (const std::size_t k : {0U, 1U}) scenes_[k].watch(body.ids[k], other.ids[k]);
          break;
        case 4:
          body.positions[0].x() = std::numeric_limits<double>::quiet_NaN();
          break;
        case 5:
          rules_changed_ = true;
          set_rule(random_.chance(0.5) ? 0.01 : 0.05);
          break;
        case 6:  // and its box stays
          std::swap(body.positions[1], body.positions[2]);
          break;
        default:
          move(body);
      }
    }
  }
  /// The report of the scene in which pairs rest, and that of the other.
  std::array<ReportHandle, 2> step() {
    scenes_[1].set_rule(250, 251, {.contact_distance = 1, .range = 1});
    return {scenes_[0].step(), scenes_[1].step()};
  }
  [[nodiscard]] bool is_touched(ObjectId id) const {
    return rules_changed_ ||
           std::ranges::any_of(bodies_, [&](const Body& body) { return body.ids[0] == id && body.touched; });
  }

 private:
  struct Body {
    std::shared_ptr<const Mesh> mesh;
    std::array<ObjectId, 2> ids;
    Positions positions;  ///< that both scenes have bound
    bool touched = true;
  };

  void set_rule(double contact_distance) {
    for (Scene& scene : scenes_) scene.set_rule(1, 0, {.contact_distance = contact_distance, .range = 0.2});
  }
  void add() {
    const auto mesh = mesh_of(models::sphere(6 + random_.below(4), 4));
    ObjectSettings settings;
    settings.layer = 1U << random_.below(3);
    settings.collides_with = random_.chance(0.2) ? 3 : ~0U;
    settings.group = random_.below(12);
    settings.kind = random_.below(2);
    settings.margin = random_.chance(0.2) ? 0.01 : 0;
    settings.motion = random_.chance(0.2) ? Motion::fixed : Motion::deformable;
    Body body;
    body.mesh = mesh;
    body.positions.assign(mesh->rest().begin(), mesh->rest().end());
    for (const std::size_t k : {0U, 1U}) body.ids[k] = scenes_[k].add(mesh, settings);
    if (settings.motion == Motion::fixed) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = place();
      for (const std::size_t k : {0U, 1U}) scenes_[k].set_pose(body.ids[k], pose);
    } else {
      move(body);
      for (const std::size_t k : {0U, 1U})
        scenes_[k].bind_positions(body.ids[k], PositionView(body.positions));
    }
    bodies_.push_back(std::move(body));
  }
  Eigen::Vector3d place() { return {random_.between(-4, 4), random_.between(-4, 4), random_.between(-2, 2)}; }
  /// Elsewhere, or a little.
  void move(Body& body) {
    const Eigen::Vector3d middle = body.positions[0].allFinite() ? body.positions[0] : place();
    const Eigen::Vector3d to = random_.chance(0.5) ? place() : Eigen::Vector3d(middle + 0.02 * place());
    for (std::size_t i = 0; i < body.positions.size(); ++i)
      body.positions[i] = 0.4 * body.mesh->rest()[i] + to + 0.01 * place();
  }

  oracle::Random random_;
  std::array<Scene, 2> scenes_;
  std::vector<Body> bodies_;
  bool rules_changed_ = false;
};

}  // namespace

TEST_CASE("rest: pairs that rest among others that do not are as if they had been tested") {
  std::uint64_t rested = 0;
  std::uint64_t ended = 0;
  std::uint32_t seed = 0;
  constexpr std::uint64_t steps = 20 + repeats(60);
  for (const ContactDetail detail :
       {ContactDetail::none, ContactDetail::vertices, ContactDetail::features, ContactDetail::nearest}) {
    SceneSettings settings = settings_of(0.02, 0.1, detail);
    settings.threads = ++seed;
    Heap heap(settings, seed);
    for (std::uint64_t step = 0; step < steps; ++step) {
      heap.happen();
      const auto [resting, tested] = heap.step();
      INFO("step " << step << ", detail " << static_cast<int>(detail));
      REQUIRE(difference_of(*resting, *tested) == "");
      REQUIRE(inconsistency_of(*resting) == "");
      const StepStatistics& statistics = resting->statistics();
      const StepStatistics& other = tested->statistics();
      REQUIRE(statistics.pairs_unchanged + statistics.pairs_tested == other.pairs_tested);
      REQUIRE(statistics.pairs_filtered == other.pairs_filtered);
      REQUIRE(statistics.pairs_apart == other.pairs_apart);
      REQUIRE(statistics.contacts == other.contacts);
      REQUIRE(statistics.pairs_in_contact == other.pairs_in_contact);
      rested += statistics.pairs_unchanged;
      for (const PairReport& row : resting->pairs()) ended += row.phase == PairPhase::ended ? 1U : 0U;
    }
  }
  CHECK(rested > 60 * steps);
  CHECK(ended > steps / 2);
}

TEST_CASE("rest: distances of regions stay with the pairs that rest") {
  SceneSettings settings = settings_of(0.1, 1);
  settings.region_distances = 4096;
  Heap heap(settings, 5);
  ReportHandle last;
  std::size_t compared = 0;
  for (int step = 0; step < 100; ++step) {
    heap.happen();
    const ReportHandle report = heap.step()[0];
    REQUIRE(inconsistency_of(*report) == "");
    for (const PairReport& row : report->pairs()) {
      const PairReport* const before = last ? find_pair(*last, row.a, row.b) : nullptr;
      if (before == nullptr || heap.is_touched(row.a) || heap.is_touched(row.b)) continue;
      if (row.phase == PairPhase::ended) continue;  // one of the objects is gone
      const auto now = report->region_distances(row);
      const auto same = [](const RegionDistance& left, const RegionDistance& right) {
        return left.region_a == right.region_a && left.region_b == right.region_b &&
               left.distance == right.distance;
      };
      REQUIRE(std::ranges::equal(now, last->region_distances(*before), same));
      compared += now.size();
    }
    last = report;
  }
  CHECK(compared > 3'000);
}

TEST_CASE("rest: reports say the same as where something else moves, whatever happens in between") {
  RestingAndNot scenes(settings_of(0.5, 1));
  std::mt19937 random(11);
  std::size_t shared = 0;
  ReportHandle last;
  for (int step = 0; step < 600; ++step) {
    const auto event = random() % 24;
    scenes.tell([&](NeedleOverPlate& pair) {
      switch (event) {
        case 0:
          return pair.lift(0.25);
        case 1:
          return pair.lift(0.75);
        case 2:
          return pair.lift(5);
        case 3:
          return pair.scene.ignore(pair.plate, pair.needle);
        case 4:
        case 5:
          return pair.scene.watch(pair.plate, pair.needle);
        case 6:
          return pair.scene.set_rule(0, 0, {.contact_distance = 0.8, .range = 1});
        case 7:
          return pair.scene.set_rule(0, 0, {.contact_distance = 0.5, .range = 1});
        case 8:
          return pair.scene.set_pose(pair.needle, lift_pose(0));  // a diagnostic, and no change
        case 9:
          return pair.scene.unbind_positions(pair.needle);
        default:
          return;
      }
    });
    const ReportHandle report = scenes.step();
    if (last && shares_rows(last, report) && !report->pairs().empty()) ++shared;
    last = report;
  }
  CHECK(shared > 100);
}

TEST_CASE("rest: objects that come, go and are replaced are seen") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  const auto settle = [&] {
    for (int step = 0; step < 4; ++step) (void)pair.scene.step();
    return pair.scene.latest_report();
  };
  pair.lift(0.25);
  CHECK(settle()->pairs().size() == 1);
  const ObjectId other = pair.scene.add(needle_mesh());
  CHECK(pair.scene.step()->pairs().size() == 3);
  CHECK(settle()->pairs().size() == 3);
  const auto ended = [&] {
    const ReportHandle report = pair.scene.step();
    return std::ranges::count(report->pairs(), PairPhase::ended, &PairReport::phase);
  };
  pair.scene.remove(pair.needle);
  CHECK(ended() == 2);
  CHECK(settle()->pairs().size() == 1);
  pair.scene.remove(other);
  CHECK(ended() == 1);
  CHECK(settle()->pairs().empty());
}

TEST_CASE("rest: bound memory is read in every step, and what moves in it or freezes is seen") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  Positions positions = lifted(*needle_mesh(), 0.25);
  pair.scene.bind_positions(pair.needle, PositionView(positions));
  ReportHandle last = pair.scene.step();
  std::size_t shared = 0;
  const auto step = [&] {
    const ReportHandle report = pair.scene.step();
    if (shares_rows(last, report)) ++shared;
    last = report;
    return report;
  };
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 4; ++i) CHECK(only_pair(*step()).distance.upper == 0.25);
    std::ranges::copy(lifted(*needle_mesh(), 0.375), positions.begin());
    for (int i = 0; i < 4; ++i) CHECK(only_pair(*step()).distance.upper == 0.375);
    positions[0].x() = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 4; ++i) {
      CHECK(only_pair(*step()).stale);
      CHECK(last->diagnostics().size() == 1);
    }
    std::ranges::copy(lifted(*needle_mesh(), 0.375), positions.begin());
    for (int i = 0; i < 4; ++i) CHECK_FALSE(only_pair(*step()).stale);
    std::ranges::copy(lifted(*needle_mesh(), 0.25), positions.begin());
  }
  CHECK(shared >= 12);
}

TEST_CASE("rest: rows that reports share stay as they were while any of these is held") {
  std::vector<ReportHandle> handles;
  std::vector<std::vector<std::string>> rows;
  FrameReport copy;
  {
    NeedleOverPlate pair(settings_of(0.5, 1));
    std::mt19937 random(5);
    for (std::size_t i = 0; i < 2000; ++i) {
      if (random() % 8 == 0) pair.lift(static_cast<double>(random() % 16) / 16);
      handles.push_back(pair.scene.step());
      rows.push_back(rows_of(*handles.back()));
      if (i % 64 == 63)
        for (std::size_t j = i - 63; j <= i; ++j)
          if (random() % 4 != 0) handles[j] = ReportHandle();
    }
    copy = *handles.back();
  }
  std::size_t held = 0;
  std::size_t shared = 0;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    if (!handles[i]) continue;
    ++held;
    REQUIRE(handles[i]->frame() == i + 1);
    REQUIRE(rows_of(*handles[i]) == rows[i]);
    if (i > 0 && handles[i - 1] && shares_rows(handles[i - 1], handles[i])) ++shared;
  }
  CHECK(held > 300);
  CHECK(shared > 20);
  handles.clear();
  CHECK(rows_of(copy) == rows.back());
}

TEST_CASE("rest: threads read shared rows by their handles while the scene rests and moves") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  constexpr std::size_t frames = 30'000;
  // An entry is written before its step, and read only through a report of that step.
  std::vector<double> heights(frames + 1, 0);
  pair.lift(0.5);
  pair.scene.step();
  heights[1] = 0.5;
  std::atomic<bool> is_over = false;
  std::atomic<std::size_t> wrong = 0;
  std::atomic<std::size_t> reads = 0;
  const auto read = [&] {
    std::array<ReportHandle, 5> held;
    for (std::size_t i = 0; !is_over; ++i) {
      held[i % held.size()] = pair.scene.latest_report();
      for (const ReportHandle& report : held) {
        if (!report) continue;
        ++reads;
        const bool is_right =
            report->pairs().size() == 1 && report->pairs()[0].distance.upper == heights[report->frame()];
        if (!is_right) ++wrong;
      }
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) readers.emplace_back(read);
  while (reads == 0) std::this_thread::yield();
  std::mt19937 random(3);
  std::size_t shared = 0;
  ReportHandle last = pair.scene.latest_report();
  for (std::size_t frame = 2; frame <= frames; ++frame) {
    heights[frame] = heights[frame - 1];
    if (random() % 6 == 0) pair.lift(heights[frame] = static_cast<double>(1 + random() % 15) / 16);
    const ReportHandle report = pair.scene.step();
    if (shares_rows(last, report)) ++shared;
    last = report;
  }
  is_over = true;
  for (std::thread& reader : readers) reader.join();
  CHECK(wrong == 0);
  CHECK(shared > frames / 4);
}

}  // namespace graze::tests
