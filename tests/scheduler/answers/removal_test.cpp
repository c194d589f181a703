// Contacts whose object is removed: each ends in one row, so that those begun less those ended are those
// open.

#include <map>
#include <set>
#include <utility>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using RowKey = std::pair<ObjectId, ObjectId>;

ObjectSettings with_data(std::uint64_t data, Motion motion = Motion::rigid) {
  ObjectSettings settings = motion_of(motion);
  settings.user_data = data;
  return settings;
}

Eigen::Isometry3d at(double x, double y, double z) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

/// Plates that lie on each other, 0.25 apart.
struct Stack {
  explicit Stack(std::uint32_t count) : scene(settings_of(0.5, 100)) {
    for (std::uint32_t i = 0; i < count; ++i) {
      plates.push_back(scene.add(plate_mesh(), with_data(10 + i)));
      scene.set_pose(plates.back(), lift_pose(0.25 * i));
    }
  }

  Scene scene;
  std::vector<ObjectId> plates;
};

/// The pairs that are in contact as their rows tell it, step by step.
class OpenContacts {
 public:
  /// Follows one more report, and holds it against what was open before.
  void take(const FrameReport& report, const std::map<ObjectId, std::uint64_t>& serials) {
    std::set<RowKey> listed;
    std::pair<std::uint64_t, std::uint64_t> last{};
    for (const PairReport& row : report.pairs()) {
      const RowKey key{row.a, row.b};
      const std::pair order{serials.at(row.a), serials.at(row.b)};
      REQUIRE((listed.empty() || last < order));
      last = order;
      REQUIRE(row.user_data_a == order.first);
      REQUIRE(row.user_data_b == order.second);
      listed.insert(key);
      const bool was_open = open_.count(key) > 0;
      REQUIRE(was_open == (row.phase == PairPhase::touching || row.phase == PairPhase::ended));
      if (row.phase == PairPhase::began) open_.insert(key);
      if (row.phase == PairPhase::ended) {
        open_.erase(key);
        ++ended_;
        REQUIRE(row.contact_count == 0);
      }
      if (row.phase == PairPhase::near) REQUIRE(row.contact_count == 0);
    }
    for (const RowKey& key : open_) REQUIRE(listed.count(key) == 1);
  }
  [[nodiscard]] const std::set<RowKey>& open() const { return open_; }
  [[nodiscard]] std::size_t ended() const { return ended_; }

 private:
  std::set<RowKey> open_;
  std::size_t ended_ = 0;
};

}  // namespace

TEST_CASE("a pair in contact whose object is removed ends once, with both objects' user data") {
  Stack stack(2);
  stack.scene.step();
  stack.scene.remove(stack.plates[GENERATE(0U, 1U)]);
  const ReportHandle report = stack.scene.step();
  const PairReport& row = only_pair(*report);
  CHECK(row.phase == PairPhase::ended);
  CHECK(row.a == stack.plates[0]);
  CHECK(row.b == stack.plates[1]);
  CHECK(row.user_data_a == 10);
  CHECK(row.user_data_b == 11);
  CHECK(row.contact_count == 0);
  CHECK(row.complete);
  CHECK_FALSE(row.stale);
  CHECK(row.distance.upper == 0.25);
  CHECK(report->contacts().empty());
  CHECK(report->statistics().pairs_near == 1);
  CHECK(report->statistics().pairs_in_contact == 0);
  CHECK(stack.scene.step()->pairs().empty());
  CHECK(stack.scene.step()->pairs().empty());
}

TEST_CASE("a pair that is only near is not listed after its object was removed") {
  Stack stack(2);
  stack.scene.set_pose(stack.plates[1], lift_pose(3));
  CHECK(only_pair(*stack.scene.step()).phase == PairPhase::near);
  stack.scene.remove(stack.plates[1]);
  CHECK(stack.scene.step()->pairs().empty());
}

TEST_CASE("rows of removed objects stand where they stood among all others") {
  Stack stack(5);
  const ReportHandle before = stack.scene.step();
  CHECK(before->pairs().size() == 10);
  stack.scene.remove(stack.plates[3]);
  stack.scene.remove(stack.plates[1]);
  const ObjectId added = stack.scene.add(plate_mesh(), with_data(15));
  stack.scene.set_pose(added, lift_pose(1.25));
  SECTION("while all others rest") {}
  SECTION("while one moves") {
    stack.scene.set_pose(stack.plates[2], lift_pose(0.625));
  }
  const ReportHandle report = stack.scene.step();
  std::vector<std::pair<std::uint64_t, std::uint64_t>> rows;
  std::size_t ended = 0;
  for (const PairReport& row : report->pairs()) {
    rows.emplace_back(row.user_data_a, row.user_data_b);
    const bool is_gone =
        row.user_data_a == 11 || row.user_data_b == 11 || row.user_data_a == 13 || row.user_data_b == 13;
    CHECK((row.phase == PairPhase::ended) == is_gone);
    if (is_gone) ++ended;
  }
  CHECK(std::is_sorted(rows.begin(), rows.end()));
  // Plates are in contact with their neighbours alone: 0-1, 1-2, 2-3 and 3-4 ended.
  CHECK(ended == 4);
  for (const PairReport& row : stack.scene.step()->pairs()) CHECK(row.phase != PairPhase::ended);
}

TEST_CASE("ignored and removed in one step, a pair ends once") {
  Stack stack(2);
  stack.scene.step();
  stack.scene.ignore(stack.plates[0], stack.plates[1]);
  SECTION("at once") {
    stack.scene.remove(stack.plates[0]);
  }
  CHECK(only_pair(*stack.scene.step()).phase == PairPhase::ended);
  CHECK(stack.scene.step()->pairs().empty());
}

TEST_CASE("a removed object's pairs end where a step repeats all other rows") {
  Stack stack(3);
  for (int i = 0; i < 4; ++i) stack.scene.step();
  stack.scene.remove(stack.plates[0]);
  const ReportHandle report = stack.scene.step();
  REQUIRE(report->pairs().size() == 2);
  CHECK(report->pairs()[0].phase == PairPhase::ended);
  CHECK(report->pairs()[1].phase == PairPhase::touching);
  CHECK(report->contacts(report->pairs()[1]).size() > 0);
  for (int i = 0; i < 3; ++i) CHECK(only_pair(*stack.scene.step()).phase == PairPhase::touching);
}

TEST_CASE("10,000 steps of adds, removes, ignores, rules and poses: what began and did not end is open") {
  oracle::Random random(11);
  SceneSettings settings = settings_of(0.3, 1, ContactDetail::closest);
  settings.threads = 2;
  Scene scene(settings);
  std::vector<ObjectId> alive;
  std::map<ObjectId, std::uint64_t> serials;
  std::uint64_t next_serial = 1;
  OpenContacts contacts;
  const auto any = [&] { return alive[random.below(static_cast<std::uint32_t>(alive.size()))]; };
  const auto place = [&] {
    const Eigen::Vector3d offset{random.between(-2, 2), random.between(-2, 2), random.between(-1, 1)};
    return at(offset.x(), offset.y(), offset.z());
  };
  for (int step = 0; step < 10000; ++step) {
    for (std::uint32_t calls = random.below(4); calls-- > 0;) {
      if (alive.size() < 3 || (alive.size() < 9 && random.chance(0.2))) {
        ObjectSettings object = with_data(next_serial, random.chance(0.2) ? Motion::fixed : Motion::rigid);
        object.kind = random.below(2);
        const ObjectId id = scene.add(plate_mesh(), object);
        serials[id] = next_serial++;
        alive.push_back(id);
        scene.set_pose(id, place());
      } else if (random.chance(0.15)) {
        const auto gone = alive.begin() + random.below(static_cast<std::uint32_t>(alive.size()));
        scene.remove(*gone);
        alive.erase(gone);
      } else if (random.chance(0.2)) {
        const ObjectId one = any();
        const ObjectId other = any();
        if (one == other) continue;
        random.chance(0.5) ? scene.ignore(one, other) : scene.watch(one, other);
      } else if (random.chance(0.1)) {
        const std::uint32_t kind = random.below(2);
        const std::uint32_t other_kind = random.below(2);
        scene.set_rule(kind, other_kind, {random.between(0, 0.6), random.between(0, 2), {}});
      } else {
        Eigen::Isometry3d pose = place();
        if (random.chance(0.1)) pose.linear() *= 2;  // refused
        scene.set_pose(any(), pose);
      }
    }
    contacts.take(*scene.step(), serials);
  }
  for (const ObjectId id : alive) scene.remove(id);
  contacts.take(*scene.step(), serials);
  CHECK(contacts.open().empty());
  CHECK(contacts.ended() > 1000);
  CHECK(scene.step()->pairs().empty());
}

}  // namespace graze::tests
