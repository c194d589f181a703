// Which pairs the broad phase keeps, against a test of all n(n-1)/2 of them. Also what each filter takes out.

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "broad_phase/broad_phase.hpp"
#include "pairs/pair_set.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Objects = std::vector<std::unique_ptr<Object>>;
using Pairs = std::vector<SlotPair>;

Box box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& half) {
  Box box;
  box.add(Eigen::Vector3d(centre - half));
  box.add(Eigen::Vector3d(centre + half));
  return box;
}

bool meet(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) return false;
  return true;
}

bool is_inside(const Box& inner, const Box& outer) {
  for (int axis = 0; axis < 3; ++axis)
    if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
  return true;
}

/// Pairs of serials that are ignored.
struct IgnoredSet final : IgnoredPairs {
  [[nodiscard]] bool is_empty() const override { return pairs.empty(); }
  [[nodiscard]] bool contains(const Serials& pair) const override { return pairs.contains(pair); }
  [[nodiscard]] std::optional<std::span<const Serials>> changed() const override {
    if (are_too_many) return std::nullopt;
    return changes;
  }
  void set(const Serials& pair, bool is_ignored) {
    if (is_ignored)
      pairs.insert(pair);
    else
      pairs.erase(pair);
    changes.push_back(pair);
  }

  std::set<Serials> pairs;
  std::vector<Serials> changes;
  bool are_too_many = false;
};

/// Objects that are boxes only: they drift, rest, jump, explode, gather in one place, come and go. There are
/// so many sorts of layers, and filters only if there are any.
class BoxWorld {
 public:
  explicit BoxWorld(std::uint64_t seed, std::uint32_t layers = 0) : random_(seed), layers_(layers) {}

  void add() {
    auto object = std::make_unique<Object>();
    object->serial = next_serial_;
    next_serial_ += 1 + random_.below(3);
    object->settings.kind = random_.below(3);
    object->settings.margin = random_.chance(0.2) ? random_.between(0, 2) : 0;
    object->box = random_box();
    if (layers_ > 0) filter(object->settings);
    objects_.push_back(std::move(object));
  }
  /// Ignores or watches pairs, of objects that are gone too.
  void change_ignored(IgnoredSet& ignored, std::uint32_t count) {
    for (; count > 0; --count) {
      const auto a = random_.below(static_cast<std::uint32_t>(next_serial_));
      const auto b = random_.below(static_cast<std::uint32_t>(next_serial_));
      if (a != b) ignored.set(std::minmax<std::uint64_t>(a, b), random_.chance(0.7));
    }
  }
  void remove_some(double share) {
    std::erase_if(objects_, [&](const auto&) { return random_.chance(share); });
  }
  /// Moves that share of the objects.
  void move_some(double share) {
    for (const auto& object : objects_) {
      if (!random_.chance(share)) continue;
      if (random_.chance(0.05)) {
        object->box = random_box();
        continue;
      }
      const double step = 0.05 * (object->box.max - object->box.min).maxCoeff();
      const Eigen::Vector3d by = random_vector(step);
      object->box.min += by;
      object->box.max += by;
    }
  }

  [[nodiscard]] const Objects& objects() const { return objects_; }

 private:
  Eigen::Vector3d random_vector(double size) {
    return {random_.between(-size, size), random_.between(-size, size), random_.between(-size, size)};
  }
  Box random_box() {
    if (random_.chance(0.1)) return box_at({1, 2, 3}, {0.5, 0.5, 0.5});
    if (random_.chance(0.01)) return box_at(random_vector(0x1p119), Eigen::Vector3d::Constant(0x1p119));
    const double size = std::pow(10.0, random_.between(-3, 3));
    const double spread = random_.chance(0.3) ? 5 : 3000;
    const double width = size * random_.between(0, 1);
    return box_at(random_vector(spread), Eigen::Vector3d(size, width, size / 2));
  }

  void filter(ObjectSettings& settings) {
    settings.motion = random_.chance(0.4) ? Motion::fixed : Motion::rigid;
    settings.layer = 1U << random_.below(std::min(layers_, 31U));
    settings.collides_with = random_.chance(0.5) ? ~0U : ~(1U << random_.below(std::min(layers_, 31U)));
    settings.group = random_.chance(0.5) ? 0 : random_.below(5);
  }

  oracle::Random random_;
  Objects objects_;
  std::uint64_t next_serial_ = 1;
  std::uint32_t layers_;
};

PairVerdict verdict_of(const Objects& objects, const IgnoredSet& ignored, std::uint32_t a, std::uint32_t b) {
  const ObjectSettings& one = objects[a]->settings;
  const ObjectSettings& other = objects[b]->settings;
  if (one.motion == Motion::fixed && other.motion == Motion::fixed) return PairVerdict::fixed;
  if ((one.layer & other.collides_with) == 0 || (other.layer & one.collides_with) == 0)
    return PairVerdict::layer;
  if (one.group != 0 && one.group == other.group) return PairVerdict::group;
  return ignored.contains({objects[a]->serial, objects[b]->serial}) ? PairVerdict::ignored
                                                                    : PairVerdict::tested;
}

/// The pairs of boxes that meet, and that no filter takes out.
Pairs pairs_that_meet(std::span<const Box> boxes, const Objects& objects, const IgnoredSet& ignored) {
  Pairs pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      if (meet(boxes[a], boxes[b]) && verdict_of(objects, ignored, a, b) == PairVerdict::tested)
        pairs.push_back(pair_of(a, b));
  return pairs;
}

std::vector<Box> needed_boxes(const Objects& objects, const BroadPhase::HalfReaches& reaches) {
  std::vector<Box> boxes;
  for (const auto& object : objects)
    boxes.push_back(grown(object->box, reaches[object->settings.kind] + object->settings.margin));
  return boxes;
}

/// A broad phase with what it works on.
struct BroadPhaseRun {
  explicit BroadPhaseRun(unsigned threads) : tasks(threads, ArenaPolicy::own) {}
  std::span<const SlotPair> find(const Objects& objects, const BroadPhase::HalfReaches& reaches) {
    summaries.refresh(objects, tasks);
    const auto pairs = broad_phase.find(summaries, reaches, ignored, tasks);
    ignored.changes.clear();
    ignored.are_too_many = false;
    return pairs;
  }
  TaskPool tasks;
  IgnoredSet ignored;
  ObjectSummaries summaries;
  BroadPhase broad_phase;
};

BroadPhase::HalfReaches half_reaches_of(double first, double second, double third) {
  BroadPhase::HalfReaches reaches{};
  reaches[0] = first;
  reaches[1] = second;
  reaches[2] = third;
  return reaches;
}

/// Whether the pairs are those that a look at all boxes gives, and loose boxes neither too small nor too
/// large.
void check_against_all(const BroadPhaseRun& run, std::span<const SlotPair> pairs, const Objects& objects,
                       const BroadPhase::HalfReaches& reaches) {
  const std::vector<Box> needed = needed_boxes(objects, reaches);
  const auto loose = run.broad_phase.loose_boxes();
  REQUIRE(loose.size() == needed.size());
  for (std::size_t slot = 0; slot < needed.size(); ++slot) {
    REQUIRE(is_inside(needed[slot], loose[slot]));
    const double side = (needed[slot].max - needed[slot].min).maxCoeff();
    REQUIRE(is_inside(loose[slot], grown(needed[slot], side)));
  }
  REQUIRE(Pairs(pairs.begin(), pairs.end()) == pairs_that_meet(loose, objects, run.ignored));
  const Pairs must = pairs_that_meet(needed, objects, run.ignored);
  REQUIRE(std::includes(pairs.begin(), pairs.end(), must.begin(), must.end()));
}

}  // namespace

TEST_CASE("the pairs kept are those that a look at all pairs of boxes gives") {
  std::size_t pairs_compared = 0;
  std::size_t steps_in_slack = 0;
  std::size_t steps_of_few = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    BoxWorld world(seed);
    BroadPhaseRun run(1);
    oracle::Random random(seed + 100);
    auto reaches = half_reaches_of(0, 0.1, 0.5);
    for (int frame = 0; frame < 60; ++frame) {
      if (random.chance(0.1)) {
        const std::array reach{random.between(0, 1), random.between(0, 40)};
        reaches = half_reaches_of(0, reach[0], reach[1]);
      }
      if (random.chance(0.2)) world.remove_some(random.between(0, 0.5));
      if (frame == 0 || random.chance(0.3))
        for (std::uint32_t i = random.below(frame % 10 == 0 ? 300 : 10); i > 0; --i) world.add();
      constexpr std::array shares = {0.0, 0.01, 0.1, 1.0};
      world.move_some(shares[random.below(4)]);
      const auto pairs = run.find(world.objects(), reaches);
      check_against_all(run, pairs, world.objects(), reaches);
      pairs_compared += pairs.size();
      const BroadPhase::Counters& counters = run.broad_phase.counters();
      steps_in_slack += counters.objects_in_slack > 0 ? 1U : 0U;
      steps_of_few +=
          counters.boxes_tested > 0 && counters.boxes_tested < 4 * world.objects().size() ? 1U : 0U;
    }
  }
  CHECK(pairs_compared > 100000);
  CHECK(steps_in_slack > 50);
  CHECK(steps_of_few > 20);
}

TEST_CASE("pairs that filters take out are not kept, and come back when they are watched") {
  std::uint64_t kept = 0;
  std::array<std::uint64_t, 4> counted{};
  std::size_t steps_of_few = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    // With 31 layers there are more sorts of objects than a tree has bits for.
    BoxWorld world(seed, std::array{1U, 3U, 31U, 31U}[seed % 4]);
    BroadPhaseRun run(1);
    oracle::Random random(seed + 200);
    const auto reaches = half_reaches_of(0.1, 0.1, 0.5);
    for (int frame = 0; frame < 60; ++frame) {
      if (random.chance(0.1)) world.remove_some(random.between(0, 0.5));
      if (frame == 0 || random.chance(0.2))
        for (std::uint32_t i = random.below(frame % 10 == 0 ? 300 : 10); i > 0; --i) world.add();
      world.change_ignored(run.ignored, random.below(random.chance(0.2) ? 3000 : 20));
      run.ignored.are_too_many = random.chance(0.1);
      constexpr std::array shares = {0.0, 0.01, 0.05, 1.0};
      world.move_some(shares[random.below(random.chance(0.2) ? 4 : 3)]);
      const auto pairs = run.find(world.objects(), reaches);
      check_against_all(run, pairs, world.objects(), reaches);
      kept += pairs.size();
      const std::uint64_t tested = run.broad_phase.counters().boxes_tested;
      steps_of_few += tested > 0 && tested < 4 * world.objects().size() ? 1U : 0U;
      std::array<std::uint64_t, 5> expected{};
      for (std::uint32_t b = 0; b < world.objects().size(); ++b)
        for (std::uint32_t a = 0; a < b; ++a)
          ++expected[static_cast<std::size_t>(verdict_of(world.objects(), run.ignored, a, b))];
      const FilteredPairs& filtered = run.broad_phase.filtered();
      REQUIRE(filtered.fixed == expected[1]);
      REQUIRE(filtered.by_layer == expected[2]);
      REQUIRE(filtered.in_group == expected[3]);
      for (std::size_t i = 0; i < counted.size(); ++i) counted[i] += expected[i + 1];
    }
  }
  CHECK(kept > 10000);
  for (const std::uint64_t count : counted) CHECK(count > 1000);
  CHECK(steps_of_few > 20);
}

TEST_CASE("objects that can never touch are not looked for among each other") {
  BroadPhaseRun run(1);
  Objects objects;
  for (std::uint64_t serial = 1; serial <= 4000; ++serial) {
    auto object = std::make_unique<Object>();
    object->serial = serial;
    object->box = box_at({1, 2, 3}, {0.5, 0.5, 0.5});
    // Four sorts in one place: fixed, two groups, and a layer that only meets a fifth sort.
    object->settings.motion = serial % 4 == 0 ? Motion::fixed : Motion::rigid;
    object->settings.group = serial % 4 == 1 ? 7 : serial % 4 == 2 ? 8 : 0;
    object->settings.layer = 1U << serial % 4;
    object->settings.collides_with = (1U << serial % 4) | 16U;
    if (serial % 4 == 3) object->settings.collides_with = 16;
    objects.push_back(std::move(object));
  }
  CHECK(run.find(objects, half_reaches_of(0, 0, 0)).empty());
  CHECK(run.broad_phase.counters().boxes_tested < 40 * objects.size());
  const FilteredPairs& filtered = run.broad_phase.filtered();
  CHECK(filtered.fixed == 1000 * 999 / 2);
  CHECK(filtered.in_group == 1000 * 999);
  CHECK(filtered.fixed + filtered.by_layer + filtered.in_group == 4000ULL * 3999 / 2);
}

TEST_CASE("an empty scene, one object, and a scene that is emptied keep no pair") {
  BroadPhaseRun run(1);
  BoxWorld world(1);
  const BroadPhase::HalfReaches reaches{};
  CHECK(run.find(world.objects(), reaches).empty());
  world.add();
  CHECK(run.find(world.objects(), reaches).empty());
  for (int i = 0; i < 100; ++i) world.add();
  CHECK_FALSE(run.find(world.objects(), reaches).empty());
  world.remove_some(1);
  CHECK(run.find(world.objects(), reaches).empty());
  for (int i = 0; i < 100; ++i) world.add();
  check_against_all(run, run.find(world.objects(), reaches), world.objects(), reaches);
}

TEST_CASE("with an infinite reach all pairs are kept, and no longer when it is finite again") {
  BroadPhaseRun run(1);
  BoxWorld world(2);
  for (int i = 0; i < 100; ++i) world.add();
  auto reaches = half_reaches_of(0, 0, 0);
  const std::size_t before = run.find(world.objects(), reaches).size();
  reaches.fill(std::numeric_limits<double>::infinity());
  CHECK(run.find(world.objects(), reaches).size() == 100 * 99 / 2);
  reaches = half_reaches_of(0, 0, 0);
  CHECK(run.find(world.objects(), reaches).size() <= before + before / 4);
}

TEST_CASE("pairs and counters are the same for any number of threads") {
  constexpr auto reaches = 0.25;
  std::array<BroadPhaseRun, 3> runs = {BroadPhaseRun(1), BroadPhaseRun(2), BroadPhaseRun(3)};
  BoxWorld world(3);
  for (int i = 0; i < 5000; ++i) world.add();
  for (int frame = 0; frame < 12; ++frame) {
    world.move_some(frame % 3 == 0 ? 1 : 0.02);
    if (frame == 6) world.remove_some(0.1);
    const auto all = half_reaches_of(reaches, reaches, reaches);
    const auto expected = runs[0].find(world.objects(), all);
    REQUIRE_FALSE(expected.empty());
    for (BroadPhaseRun& run : runs) {
      if (&run == &runs[0]) continue;
      const auto found = run.find(world.objects(), all);
      REQUIRE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
      REQUIRE(run.broad_phase.counters().boxes_tested == runs[0].broad_phase.counters().boxes_tested);
      REQUIRE(run.broad_phase.counters().objects_in_slack == runs[0].broad_phase.counters().objects_in_slack);
    }
  }
}

TEST_CASE("a set of pairs holds what a sorted set does") {
  oracle::Random random(5);
  PairSet pairs;
  std::set<PairSet::Pair> expected;
  std::size_t erased = 0;
  for (int i = 0; i < 20000; ++i) {
    const PairSet::Pair pair{random.below(40), random.below(40)};
    if (random.chance(0.5)) {
      pairs.insert(pair);
      expected.insert(pair);
    } else {
      pairs.erase(pair);
      erased += expected.erase(pair);
    }
    if (i % 4000 == 0) {
      const auto is_gone = [](const PairSet::Pair& of) { return of.first % 5 == 0; };
      pairs.erase_if(is_gone);
      std::erase_if(expected, is_gone);
    }
    REQUIRE(pairs.size() == expected.size());
    const PairSet::Pair other{random.below(40), random.below(40)};
    REQUIRE(pairs.contains(other) == expected.contains(other));
  }
  CHECK(erased > 1000);
  CHECK(pairs.capacity() <= 4096);
}

TEST_CASE("each filter's counter is what a look at all pairs gives") {
  oracle::Random random(6);
  std::array<std::uint64_t, 4> seen{};
  for (int round = 0; round < 10; ++round) {
    Scene scene(settings_of(0.5, 1));
    std::vector<ObjectSettings> settings(12);
    std::vector<ObjectId> ids;
    for (ObjectSettings& object : settings) {
      object.motion = random.chance(0.3) ? Motion::fixed : Motion::rigid;
      object.layer = 1U << random.below(2);
      object.collides_with = 1 + random.below(3);
      object.group = random.below(4);
      ids.push_back(scene.add(plate_mesh(), object));
    }
    std::set<std::pair<std::size_t, std::size_t>> ignored;
    for (int i = 0; i < 20; ++i) {
      const std::size_t a = random.below(12);
      const std::size_t b = random.below(12);
      if (a == b) continue;
      scene.ignore(ids[a], ids[b]);
      ignored.insert(std::minmax(a, b));
    }
    std::array<std::uint64_t, 4> expected{};
    const ReportHandle report = scene.step();
    for (std::size_t a = 0; a < ids.size(); ++a)
      for (std::size_t b = a + 1; b < ids.size(); ++b) {
        const ObjectSettings& one = settings[a];
        const ObjectSettings& other = settings[b];
        const bool fixed = one.motion == Motion::fixed && other.motion == Motion::fixed;
        const bool layer = (one.layer & other.collides_with) == 0 || (other.layer & one.collides_with) == 0;
        const bool group = one.group != 0 && one.group == other.group;
        const bool taken_out = fixed || layer || group || ignored.contains({a, b});
        CHECK((find_pair(*report, ids[a], ids[b]) == nullptr) == taken_out);
        if (taken_out) ++expected[fixed ? 0 : layer ? 1 : group ? 2 : 3];
      }
    const StepStatistics& found = report->statistics();
    CHECK(found.pairs_close + found.pairs_filtered == found.pairs_total);  // all are in one place
    CHECK(found.pairs_fixed == expected[0]);
    CHECK(found.pairs_by_layer == expected[1]);
    CHECK(found.pairs_in_group == expected[2]);
    CHECK(found.pairs_ignored == expected[3]);
    CHECK(found.pairs_filtered == expected[0] + expected[1] + expected[2] + expected[3]);
    CHECK(found.pairs_tested == found.pairs_close);
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += expected[i];
  }
  for (const std::uint64_t count : seen) CHECK(count > 10);
}

TEST_CASE("an object that moves in its loose box is not looked for") {
  NeedleOverPlate pair(settings_of(0, 0, ContactDetail::none));
  const ReportHandle first = pair.step_at(0.03125);
  CHECK(first->statistics().pairs_close == 1);
  CHECK(first->statistics().pairs_apart == 1);
  CHECK(first->statistics().work.boxes_tested > 0);
  const ReportHandle second = pair.step_at(0.046875);
  CHECK(second->statistics().objects_in_slack == 1);
  CHECK(second->statistics().work.boxes_tested == 0);
  CHECK(second->statistics().pairs_close == 1);
  const ReportHandle third = pair.step_at(100);
  CHECK(third->statistics().objects_in_slack == 0);
  CHECK(third->statistics().work.boxes_tested > 0);
  CHECK(third->statistics().pairs_close == 0);
}

TEST_CASE("a pair that has not moved is unchanged, by count") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  CHECK(pair.step_at(0.25)->statistics().pairs_tested == 1);
  const ReportHandle again = pair.scene.step();
  CHECK(again->statistics().pairs_tested == 0);
  CHECK(again->statistics().pairs_unchanged == 1);
}

TEST_CASE("a vertex found beyond its promise is where it is from the next step on") {
  Scene scene(settings_of(0.5, 0.5));
  const ObjectId low = scene.add(plate_mesh());
  const ObjectId near = scene.add(plate_mesh());
  const ObjectId far = scene.add(plate_mesh());
  scene.set_positions(near, lifted(*plate_mesh(), 0.75));
  scene.set_positions(far, lifted(*plate_mesh(), 50));
  CHECK(scene.step()->pairs().empty());
  // It is said to move by a quarter, so it is read. It is over the far one.
  scene.set_positions(near, lifted(*plate_mesh(), 50.25), 0.5);
  CHECK(kinds_of(*scene.step()) == std::vector{DiagnosticKind::broken_promise});
  const ReportHandle report = scene.step();
  CHECK(find_pair(*report, low, near) == nullptr);
  REQUIRE(find_pair(*report, near, far) != nullptr);
  CHECK(find_pair(*report, near, far)->distance.upper == 0.25);
}

}  // namespace graze::tests
