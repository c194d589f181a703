// Hidden groups in scenes: random scenes with calls between steps against brute force and scenes built
// afresh, phases, other meshes, solids, and what no call brings back.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"
#include "support/random/random_solids.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

using Groups = std::vector<std::uint8_t>;

constexpr std::uint32_t group_count = 3;

/// An object as calls have left it.
struct HiddenObject {
  Shape rest;
  Shape now;
  ObjectSettings settings;
  ObjectId id;

  [[nodiscard]] bool hides(std::uint32_t face) const {
    const Groups& hidden = settings.hidden_groups;
    const std::uint8_t group = settings.face_groups.empty() ? 0 : settings.face_groups[face];
    return std::find(hidden.begin(), hidden.end(), group) != hidden.end();
  }
};

/// Two shapes in two scenes, of one thread and of two, and what the calls on both say so far.
class HiddenScenes {
 public:
  HiddenScenes(std::uint64_t seed, ContactDetail detail)
      : random_(seed), detail_(detail), range_(seed % 3 == 0 ? std::numeric_limits<double>::infinity() : 1) {
    oracle::RandomScene given = oracle::random_scene(seed);
    threshold_ = given.threshold;
    a_ = {given.a, given.a, settings_for(given.a), {}};
    b_ = {given.b, given.b, settings_for(given.b), {}};
    for (const unsigned threads : {1U, 2U}) {
      scenes_.emplace_back(settings_with(threads));
      for (HiddenObject* const object : {&a_, &b_})
        object->id = scenes_.back().add(mesh_of(object->rest), object->settings);
    }
  }

  void step() {
    if (random_.chance(0.6)) move();
    if (random_.chance(0.4)) change_groups();
    if (random_.chance(0.2)) replace(random_.chance(0.5) ? a_ : b_);
    const ReportHandle report = scenes_[0].step();
    REQUIRE(inconsistency_of(*report) == "");
    REQUIRE(difference_of(*report, *scenes_[1].step()) == "");
    if (pairs().are_some())  // otherwise a row is there because the pair ended
      REQUIRE(timeless_rows_of(*report, range_) == timeless_rows_of(*afresh(), range_));
    if (detail_ != ContactDetail::nearest) compare_with_brute_force(*report);
    was_in_contact_ = false;
    for (const PairReport& pair : report->pairs())
      was_in_contact_ = pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
    contacts += report->contacts().size();
  }

  std::size_t contacts = 0;
  std::size_t hidden_whole = 0;
  std::size_t ended = 0;

 private:
  [[nodiscard]] SceneSettings settings_with(unsigned threads) const {
    SceneSettings settings = settings_of(threshold_, range_, detail_);
    settings.threads = threads;
    return settings;
  }
  Groups random_groups(std::size_t face_count) {
    Groups groups;
    if (random_.chance(0.2)) return groups;
    for (std::size_t face = 0; face < face_count; ++face)
      groups.push_back(static_cast<std::uint8_t>(random_.below(group_count)));
    return groups;
  }
  ObjectSettings settings_for(const Shape& shape) {
    ObjectSettings settings;
    settings.face_groups = random_groups(shape.faces.size());
    for (std::uint8_t group = 0; group <= group_count; ++group)
      if (random_.chance(0.3)) settings.hidden_groups.push_back(group);
    return settings;
  }
  void change_groups() {
    const auto group_a = static_cast<std::uint8_t>(random_.below(group_count));
    const auto group_b = static_cast<std::uint8_t>(random_.below(group_count));
    const bool ignored = random_.chance(0.5);
    for (Scene& scene : scenes_)
      ignored ? scene.ignore(b_.id, group_b, a_.id, group_a) : scene.watch(a_.id, group_a, b_.id, group_b);
    if (ignored)
      ignored_.insert({group_a, group_b});
    else
      ignored_.erase({group_a, group_b});
  }
  void move() {
    const double size = random_.chance(0.5) ? 0.03125 : 0.5;
    const Eigen::Vector3d way = random_.vector(-size, size);
    for (Eigen::Vector3d& position : b_.now.positions) position += way;
    for (Scene& scene : scenes_) scene.set_positions(b_.id, b_.now.positions);
  }
  /// Takes the last face away, and gives the others other groups.
  void replace(HiddenObject& object) {
    if (object.rest.faces.size() < 2) return;
    object.rest.faces.pop_back();
    object.now.faces.pop_back();
    std::vector<std::uint32_t> same(object.rest.positions.size());
    std::iota(same.begin(), same.end(), 0U);
    object.settings.face_groups = random_groups(object.rest.faces.size());
    for (Scene& scene : scenes_) {
      scene.replace_mesh(object.id, mesh_of(object.rest), same, object.settings.face_groups);
      scene.set_positions(object.id, object.now.positions);
    }
  }

  /// A scene built afresh with what is there now.
  [[nodiscard]] ReportHandle afresh() const {
    Scene scene(settings_with(1));
    std::array<ObjectId, 2> ids;
    for (const std::size_t i : {0U, 1U}) {
      const HiddenObject& object = i == 0 ? a_ : b_;
      ids[i] = scene.add(mesh_of(object.rest), object.settings);
      scene.set_positions(ids[i], object.now.positions);
    }
    for (const auto& [group_a, group_b] : ignored_) scene.ignore(ids[0], group_a, ids[1], group_b);
    return scene.step();
  }
  [[nodiscard]] oracle::FacePairs pairs() const {
    const auto group_of = [](const HiddenObject& object, std::uint32_t face) {
      return object.settings.face_groups.empty() ? std::uint8_t{0} : object.settings.face_groups[face];
    };
    return {a_.now, b_.now, [&](std::uint32_t face_a, std::uint32_t face_b) {
              return !a_.hides(face_a) && !b_.hides(face_b) &&
                     !ignored_.contains({group_of(a_, face_a), group_of(b_, face_b)});
            }};
  }
  void compare_with_brute_force(const FrameReport& report) {
    const PairReport* const row = find_pair(report, a_.id, b_.id);
    const oracle::FacePairs looked_at = pairs();
    if (!looked_at.are_some()) {
      ++hidden_whole;
      // A pair that was in contact ends with the distance of its whole surfaces.
      REQUIRE((row != nullptr) == was_in_contact_);
      if (row == nullptr) return;
      ++ended;
      REQUIRE(row->phase == PairPhase::ended);
      check_distance(*row, {});
      return;
    }
    const Expected now = expected_of(a_.now, b_.now, threshold_, detail_, a_.rest, b_.rest, looked_at);
    REQUIRE((row != nullptr) ==
            (now.in_contact || was_in_contact_ || is_within(now.distance, std::max(range_, threshold_))));
    if (row == nullptr) return;
    REQUIRE(tests::difference_of(report.contacts(*row), now.contacts, {a_.now, b_.now}) == "");
    check_distance(*row, looked_at);
  }
  void check_distance(const PairReport& row, const oracle::FacePairs& looked_at) const {
    const Expected now = expected_of(a_.now, b_.now, threshold_, detail_, a_.rest, b_.rest, looked_at);
    REQUIRE(tests::difference_of(row.distance, row.witness, now.distance, {a_.now, b_.now}) == "");
  }

  Random random_;
  ContactDetail detail_;
  double range_;
  double threshold_ = 0;
  HiddenObject a_;
  HiddenObject b_;
  std::set<std::pair<std::uint8_t, std::uint8_t>> ignored_;
  bool was_in_contact_ = false;
  std::vector<Scene> scenes_;
};

/// The plate of two triangles: group 0 has the corner (1, -1), group 5 the corner (-1, 1).
std::shared_ptr<const Mesh> plate_in_two_groups() {
  constexpr std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(plate_mesh()->rest(), triangles));
}

/// A needle whose tip stands 0.25 above the middle of a triangle of a plate. It is of group 5.
struct NeedleOverHidden {
  explicit NeedleOverHidden(const Groups& hidden, ContactDetail detail = ContactDetail::features)
      : scene(settings_of(0.5, 1, detail)) {
    ObjectSettings settings;
    settings.face_groups = {0, 5};
    settings.hidden_groups = hidden;
    plate = scene.add(plate_in_two_groups(), settings);
    needle = scene.add(needle_mesh());
    scene.set_positions(needle, lifted(*needle_mesh(), 0.25));
  }

  Scene scene;
  ObjectId plate, needle;
};

}  // namespace

TEST_CASE("hidden groups: scenes with calls between steps are those of brute force") {
  std::size_t contacts = 0;
  std::size_t hidden_whole = 0;
  std::size_t ended = 0;
  for (std::uint64_t seed = 1; seed < 120; seed += 2)
    for (const ContactDetail detail : all_details) {
      INFO("seed " << seed << ", detail " << static_cast<int>(detail));
      HiddenScenes scenes(seed, detail);
      for (int step = 0; step < 6; ++step) scenes.step();
      contacts += scenes.contacts;
      hidden_whole += scenes.hidden_whole;
      ended += scenes.ended;
    }
  CHECK(contacts > 1000);
  CHECK(hidden_whole > 100);
  CHECK(ended > 5);
}

TEST_CASE("hidden groups: solids with hidden faces are those of a scene built afresh, and inside as whole") {
  std::size_t inside = 0;
  for (std::uint64_t seed = 1; seed < 200; ++seed) {
    const oracle::RandomSolids given = oracle::random_solids(seed);
    Random random(seed);
    for (const ContactDetail detail : surface_details) {
      std::array<ObjectSettings, 2> settings;
      settings[0].solid = given.solids.a;
      settings[1].solid = given.solids.b;
      Scene whole(settings_of(given.threshold, 2, detail));
      Scene hiding(settings_of(given.threshold, 2, detail));
      std::array<std::vector<bool>, 2> hides;
      for (const std::size_t i : {0U, 1U}) {
        const Shape& shape = i == 0 ? given.a : given.b;
        (void)whole.add(mesh_of(shape), settings[i]);
        for (std::size_t face = 0; face < shape.faces.size(); ++face) {
          hides[i].push_back(face > 0 && random.chance(0.3));
          settings[i].face_groups.push_back(hides[i].back() ? 9 : 0);
        }
        settings[i].hidden_groups = {9};
        (void)hiding.add(mesh_of(shape), settings[i]);
      }
      const oracle::FacePairs pairs(given.a, given.b, [&](std::uint32_t face_a, std::uint32_t face_b) {
        return !hides[0][face_a] && !hides[1][face_b];
      });
      const ReportHandle all = whole.step();
      const ReportHandle some = hiding.step();
      INFO("seed " << seed << ", detail " << static_cast<int>(detail));
      REQUIRE(inconsistency_of(*some) == "");
      const auto inside_of = [](const FrameReport& report) {
        return report.pairs().empty() ? Inside::none : report.pairs()[0].inside;
      };
      const oracle::Containment expected = oracle::containment(given.a, given.b, given.solids, pairs);
      REQUIRE(static_cast<int>(inside_of(*some)) == static_cast<int>(expected));
      if (inside_of(*some) != Inside::none) ++inside;
      // Only hidden faces can take a piercing away.
      if (inside_of(*all) != Inside::crossing) REQUIRE(inside_of(*some) == inside_of(*all));
    }
  }
  CHECK(inside > 200);
}

TEST_CASE(
    "hidden groups: watching does not show hidden faces, and a pair of which nothing is left is in none") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverHidden stage({5}, detail);
    stage.scene.watch(stage.plate, 5, stage.needle, 0);
    const ReportHandle report = stage.scene.step();
    // The diagonal is nearest, 0.25 / sqrt(2) beside the tip.
    CHECK(only_pair(*report).distance.upper == Approx(std::sqrt(0.0625 + 0.03125)));
    CHECK(report->statistics().pairs_ignored == 0);
    stage.scene.ignore(stage.plate, 0, stage.needle, 0);
    const ReportHandle ended = stage.scene.step();
    CHECK(only_pair(*ended).phase == PairPhase::ended);
    CHECK(only_pair(*ended).distance.upper == 0.25);
    CHECK(ended->statistics().pairs_ignored == 1);
    CHECK(stage.scene.step()->pairs().empty());
    stage.scene.watch(stage.plate, 0, stage.needle, 0);
    stage.scene.watch(stage.plate, 5, stage.needle, 0);
    CHECK(only_pair(*stage.scene.step()).phase == PairPhase::began);
    CHECK(stage.scene.object_settings(stage.plate).hidden_groups == Groups{5});
  }
}

TEST_CASE("hidden groups: an object that is hidden whole meets nothing until another mesh shows some of it") {
  for (const ContactDetail detail : all_details) {
    NeedleOverHidden stage({5, 0}, detail);
    const ReportHandle report = stage.scene.step();
    CHECK(report->pairs().empty());
    CHECK(report->statistics().pairs_apart == 1);
    CHECK(report->statistics().pairs_tested == 0);
    const std::vector<std::uint32_t> same{0, 1, 2, 3};
    stage.scene.replace_mesh(stage.plate, plate_in_two_groups(), same, Groups{5, 6});
    CHECK(only_pair(*stage.scene.step()).phase != PairPhase::ended);
    const bool touches = is_about_surfaces(detail);  // at 0.25; no two vertices are as near
    stage.scene.replace_mesh(stage.plate, plate_in_two_groups(), same);
    const ReportHandle hidden = stage.scene.step();
    REQUIRE(hidden->pairs().size() == (touches ? 1 : 0));
    if (touches) CHECK(hidden->pairs()[0].phase == PairPhase::ended);
    if (touches) CHECK(hidden->pairs()[0].distance.upper == 0.25);
    CHECK(stage.scene.step()->pairs().empty());
  }
}

TEST_CASE("hidden groups: all groups may be hidden, several times, and those that no face has") {
  Groups all(600);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  CHECK(NeedleOverHidden(all).scene.step()->pairs().empty());
  CHECK(only_pair(*NeedleOverHidden({7, 7, 255}).scene.step()).distance.upper == 0.25);
}

}  // namespace graze::tests
