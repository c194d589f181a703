// Filters that change at random, while objects move, come and go: reports against a look at all pairs, and
// against a scene that is built afresh in each frame.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Needles that stand over each other or apart, with all filters that there are.
class FilteredWorld {
 public:
  explicit FilteredWorld(std::uint64_t seed) : random_(seed), scene_(settings()) {
    for (int i = 0; i < 14; ++i) add();
  }

  void happen() {
    for (std::uint32_t count = random_.below(8); count > 0; --count) {
      const std::size_t a = random_.below(static_cast<std::uint32_t>(bodies_.size()));
      const std::size_t b = random_.below(static_cast<std::uint32_t>(bodies_.size()));
      switch (random_.below(10)) {
        case 0:
          add();
          break;
        case 1:
          if (bodies_.size() > 6) remove(a);
          break;
        case 2:
        case 3:
          move(bodies_[a]);
          break;
        case 4:
        case 5:
        case 6:
          if (a != b) ignore(a, b, true);
          break;
        case 7:
          if (a != b) ignore(a, b, false);
          break;
        default:
          if (a != b) ignore_faces(a, b, random_.chance(0.6));
      }
    }
  }

  /// Steps, and compares the report with what the calls so far say.
  void step() {
    const ReportHandle report = scene_.step();
    REQUIRE(inconsistency_of(*report) == "");
    const ReportHandle afresh = built_afresh();
    std::array<std::uint64_t, 5> expected{};
    std::set<std::pair<std::uint64_t, std::uint64_t>> in_contact;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) compare(*report, *afresh, a, b, expected, in_contact);
    const StepStatistics& found = report->statistics();
    REQUIRE(found.pairs_fixed == expected[0]);
    REQUIRE(found.pairs_by_layer == expected[1]);
    REQUIRE(found.pairs_in_group == expected[2]);
    REQUIRE(found.pairs_ignored == expected[3]);
    REQUIRE(found.pairs_close <= expected[4]);
    for (const PairReport& row : report->pairs()) {
      ended += row.phase == PairPhase::ended ? 1U : 0U;
      began += row.phase == PairPhase::began ? 1U : 0U;
    }
    in_contact_ = std::move(in_contact);
  }

  std::uint64_t ended = 0;
  std::uint64_t began = 0;

 private:
  struct Body {
    std::uint64_t number = 0;
    ObjectId id;
    ObjectSettings settings;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  };
  using Numbers = std::pair<std::uint64_t, std::uint64_t>;

  static SceneSettings settings() {
    SceneSettings settings = settings_of(0.25, 0.75, ContactDetail::closest);
    settings.threads = 1;
    return settings;
  }
  void add() {
    Body body;
    body.number = next_number_++;
    body.settings.motion = random_.chance(0.3) ? Motion::fixed : Motion::rigid;
    body.settings.layer = 1U << random_.below(3);
    body.settings.collides_with = random_.chance(0.6) ? ~0U : ~(1U << random_.below(3));
    body.settings.group = random_.chance(0.6) ? 0 : random_.below(4);
    body.id = scene_.add(plate_mesh(), body.settings);
    move(body);
    bodies_.push_back(body);
  }
  void remove(std::size_t a) {
    scene_.remove(bodies_[a].id);
    bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(a));
  }
  void move(Body& body) {
    body.pose.translation() = Eigen::Vector3d(0, 0, random_.below(24) / 8.0);
    scene_.set_pose(body.id, body.pose);
  }
  static Numbers numbers_of(const Body& a, const Body& b) { return std::minmax(a.number, b.number); }
  void ignore(std::size_t a, std::size_t b, bool ignored) {
    if (ignored) {
      scene_.ignore(bodies_[a].id, bodies_[b].id);
      ignored_.insert(numbers_of(bodies_[a], bodies_[b]));
    } else {
      scene_.watch(bodies_[a].id, bodies_[b].id);
      ignored_.erase(numbers_of(bodies_[a], bodies_[b]));
    }
  }
  /// All faces are in group 0.
  void ignore_faces(std::size_t a, std::size_t b, bool ignored) {
    if (ignored) {
      scene_.ignore(bodies_[a].id, 0, bodies_[b].id, 0);
      faces_ignored_.insert(numbers_of(bodies_[a], bodies_[b]));
    } else {
      scene_.watch(bodies_[a].id, 0, bodies_[b].id, 0);
      faces_ignored_.erase(numbers_of(bodies_[a], bodies_[b]));
    }
  }
  /// Which filter takes a pair out, in the order of the counters, or 4 for none.
  [[nodiscard]] std::size_t filter_of(const Body& a, const Body& b) const {
    const ObjectSettings& one = a.settings;
    const ObjectSettings& other = b.settings;
    if (one.motion == Motion::fixed && other.motion == Motion::fixed) return 0;
    if ((one.layer & other.collides_with) == 0 || (other.layer & one.collides_with) == 0) return 1;
    if (one.group != 0 && one.group == other.group) return 2;
    return ignored_.contains(numbers_of(a, b)) || faces_ignored_.contains(numbers_of(a, b)) ? 3 : 4;
  }
  /// The first report of a scene that has no filters, with the same objects where they are.
  [[nodiscard]] ReportHandle built_afresh() {
    Scene scene(settings());
    fresh_ids_.clear();
    for (const Body& body : bodies_) {
      fresh_ids_.push_back(scene.add(plate_mesh(), motion_of(Motion::rigid)));
      scene.set_pose(fresh_ids_.back(), body.pose);
    }
    return scene.step();
  }
  void compare(const FrameReport& report, const FrameReport& afresh, std::size_t a, std::size_t b,
               std::array<std::uint64_t, 5>& expected, std::set<Numbers>& in_contact) {
    const std::size_t filter = filter_of(bodies_[a], bodies_[b]);
    ++expected[filter];
    const Numbers numbers = numbers_of(bodies_[a], bodies_[b]);
    const bool was_in_contact = in_contact_.contains(numbers);
    const PairReport* const row = find_pair(report, bodies_[a].id, bodies_[b].id);
    const PairReport* const other = find_pair(afresh, fresh_ids_[a], fresh_ids_[b]);
    INFO("objects " << numbers.first << " and " << numbers.second << ", filter " << filter);
    const bool touches = filter == 4 && other != nullptr && other->phase == PairPhase::began;
    if (touches) in_contact.insert(numbers);
    REQUIRE((row != nullptr) == ((filter == 4 && other != nullptr) || was_in_contact));
    if (row == nullptr) return;
    const double distance = std::abs(bodies_[a].pose.translation().z() - bodies_[b].pose.translation().z());
    REQUIRE(row->distance.upper == distance);
    REQUIRE(row->phase == (touches ? (was_in_contact ? PairPhase::touching : PairPhase::began)
                                   : (was_in_contact ? PairPhase::ended : PairPhase::near)));
  }

  oracle::Random random_;
  Scene scene_;
  std::vector<Body> bodies_;
  std::uint64_t next_number_ = 0;
  std::set<Numbers> ignored_;
  std::set<Numbers> faces_ignored_;
  std::set<Numbers> in_contact_;  ///< of the last report
  std::vector<ObjectId> fresh_ids_;
};

}  // namespace

TEST_CASE("filters that change at random: reports are those of a look at all pairs") {
  std::uint64_t ended = 0;
  std::uint64_t began = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    FilteredWorld world(seed);
    for (int step = 0; step < 60; ++step) {
      INFO("seed " << seed << ", step " << step);
      world.happen();
      world.step();
    }
    ended += world.ended;
    began += world.began;
  }
  CHECK(ended > 500);
  CHECK(began > 500);
}

TEST_CASE("a pair that is ignored and watched again stands as it is, in many ways") {
  // So many pairs change in one step that they are not named one by one.
  SceneSettings settings = settings_of(0.25, 0.5, ContactDetail::closest);
  settings.threads = 1;
  Scene scene(settings);
  std::vector<ObjectId> ids;
  for (int i = 0; i < 100; ++i) ids.push_back(scene.add(plate_mesh(), motion_of(Motion::rigid)));
  const auto all = [&](bool ignored) {
    for (std::size_t b = 0; b < ids.size(); ++b)
      for (std::size_t a = 0; a < b; ++a)
        ignored ? scene.ignore(ids[a], ids[b]) : scene.watch(ids[b], ids[a]);
  };
  constexpr std::size_t pairs = 100 * 99 / 2;
  CHECK(scene.step()->statistics().pairs_in_contact == pairs);
  all(true);
  const ReportHandle ended = scene.step();
  CHECK(ended->pairs().size() == pairs);
  CHECK(ended->statistics().pairs_in_contact == 0);
  CHECK(ended->statistics().pairs_ignored == pairs);
  CHECK(ended->statistics().pairs_close == 0);
  CHECK(scene.step()->pairs().empty());
  scene.watch(ids[3], ids[70]);
  CHECK(scene.step()->pairs().size() == 1);
  scene.remove(ids[5]);
  CHECK(scene.step()->statistics().pairs_ignored == pairs - 1 - 99);
  all(false);
  const ReportHandle again = scene.step();
  CHECK(again->statistics().pairs_ignored == 0);
  CHECK(again->statistics().pairs_in_contact == pairs - 99);
}

TEST_CASE("an ignored pair whose object gets another mesh and is removed is no longer counted") {
  SceneSettings settings = settings_of(0.25, 0.5, ContactDetail::closest);
  settings.threads = 1;
  Scene scene(settings);
  const ObjectId a = scene.add(plate_mesh(), motion_of(Motion::rigid));
  const ObjectId b = scene.add(plate_mesh(), motion_of(Motion::rigid));
  scene.ignore(a, b);
  CHECK(scene.step()->statistics().pairs_ignored == 1);
  std::vector<std::uint32_t> same(plate_mesh()->vertex_count());
  for (std::uint32_t vertex = 0; vertex < same.size(); ++vertex) same[vertex] = vertex;
  scene.replace_mesh(a, plate_mesh(), same);
  CHECK(scene.step()->statistics().pairs_ignored == 1);
  scene.remove(a);
  CHECK(scene.step()->statistics().pairs_ignored == 0);
}

}  // namespace graze::tests
