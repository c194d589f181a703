// Scenes with ObjectSettings::self, with random calls between steps: rows of crumpled sheets with themselves
// against brute force, against scenes built afresh, and for any number of threads.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/model_shape.hpp"
#include "support/oracle/self_pairs.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

constexpr std::uint8_t hidden_group = 3;
constexpr double range_of_sheets = 0.75;
constexpr std::uint32_t kind_of_sheets = 2;

constexpr bool has_self_pairs(ContactDetail detail) {
  return detail != ContactDetail::regions;
}

/// A flat sheet of triangles.
Shape flat_sheet(std::uint32_t columns, std::uint32_t rows) {
  Shape shape;
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t column = 0; column <= columns; ++column) shape.positions.emplace_back(column, row, 0);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t corner = row * (columns + 1) + column;
      shape.faces.push_back({corner, corner + 1, corner + columns + 2});
      shape.faces.push_back({corner, corner + columns + 2, corner + columns + 1});
    }
  return shape;
}

/// A sheet that is tested against itself, in scenes of 1 to 4 threads beside two plates, and what the calls
/// on all of them say so far.
class SheetScenes {
 public:
  SheetScenes(std::uint64_t seed, ContactDetail detail)
      : random_(seed), detail_(detail), rest_(flat_sheet(3 + random_.below(3), 2)), now_(rest_) {
    object_.self = true;
    object_.self_rings = random_.below(3);
    object_.self_at_rest = random_.chance(0.3);
    object_.kind = kind_of_sheets;
    object_.margin = random_.chance(0.5) ? 0.0625 : 0;
    for (std::size_t face = 0; face < rest_.faces.size(); ++face)
      object_.face_groups.push_back(static_cast<std::uint8_t>(random_.below(4)));
    if (random_.chance(0.3)) object_.hidden_groups = {hidden_group};
    for (unsigned threads = 1; threads <= 4; ++threads)
      sheet_ = fill(scenes_.emplace_back(settings(threads)));
  }

  /// Makes some calls, steps, and compares the reports.
  void step() {
    if (random_.chance(0.7)) move();
    if (random_.chance(0.5)) change_groups();
    if (random_.chance(0.3)) change_rule();
    const ReportHandle report = scenes_[0].step();
    REQUIRE(inconsistency_of(*report) == "");
    REQUIRE(report->diagnostics().empty());
    REQUIRE(report->statistics().pairs_total == 4);
    for (std::size_t i = 1; i < scenes_.size(); ++i)
      REQUIRE(tests::difference_of(*report, *scenes_[i].step()) == "");
    REQUIRE(timeless_rows_of(*report, range_of_sheets) == rows_afresh());
    for (const Contact& contact : report->contacts()) contacts += contact.distance > 0 ? 1U : 0U;
    const PairReport* const row = find_pair(*report, sheet_, sheet_);
    // The oracle does not know which faces of a group may lead nearer along an edge.
    if (detail_ != ContactDetail::nearest) check(*report, row);
    in_contact_ = row != nullptr && row->phase != PairPhase::near && row->phase != PairPhase::ended;
    if (row != nullptr) ++phases[static_cast<std::size_t>(row->phase)];
  }

  std::size_t contacts = 0;
  std::array<std::size_t, 4> phases{};

 private:
  [[nodiscard]] SceneSettings settings(unsigned threads) const {
    SceneSettings settings = settings_of(0.25, range_of_sheets, detail_);
    settings.threads = threads;
    return settings;
  }
  [[nodiscard]] double threshold() const { return rule_.value_or(0.25) + 2 * object_.margin; }

  /// Adds the objects in their order, and returns the sheet.
  ObjectId fill(Scene& scene) const {
    scene.add(plate_mesh());
    const ObjectId sheet = scene.add(mesh_of(rest_), object_);
    scene.add(plate_mesh());
    return sheet;
  }
  [[nodiscard]] std::vector<std::string> rows_afresh() const {
    Scene scene(settings(1));
    const ObjectId sheet = fill(scene);
    scene.set_positions(sheet, now_.positions);
    if (rule_) scene.set_rule(kind_of_sheets, kind_of_sheets, {*rule_, range_of_sheets, {}});
    for (const auto& [one, other] : ignored_) scene.ignore(sheet, one, sheet, other);
    return timeless_rows_of(*scene.step(), range_of_sheets);
  }

  /// Folds the sheet anew, or moves its vertices a little.
  void move() {
    if (random_.chance(0.4)) {
      now_ = rest_;
      const double fold = 1 + random_.below(2);
      const double gap = random_.between(-0.1, 0.4);
      for (Eigen::Vector3d& position : now_.positions)
        if (position.x() > fold) position = {2 * fold - position.x(), position.y(), gap};
    }
    const double size = random_.chance(0.5) ? 0.01 : 0.3;
    for (Eigen::Vector3d& position : now_.positions) position += random_.vector(-size, size);
    for (Scene& scene : scenes_) scene.set_positions(sheet_, now_.positions);
  }
  void change_groups() {
    const auto one = static_cast<std::uint8_t>(random_.below(4));
    const auto other = static_cast<std::uint8_t>(random_.below(4));
    const bool ignored = random_.chance(0.5);
    for (Scene& scene : scenes_)
      ignored ? scene.ignore(sheet_, one, sheet_, other) : scene.watch(sheet_, one, sheet_, other);
    if (ignored)
      ignored_.insert(std::minmax(one, other));
    else
      ignored_.erase(std::minmax(one, other));
  }
  void change_rule() {
    rule_ = random_.between(0.05, 0.6);
    for (Scene& scene : scenes_)
      scene.set_rule(kind_of_sheets, kind_of_sheets, {*rule_, range_of_sheets, {}});
  }

  [[nodiscard]] bool is_hidden(std::uint32_t face) const {
    return !object_.hidden_groups.empty() && object_.face_groups[face] == hidden_group;
  }
  [[nodiscard]] oracle::FacePairs faces() const {
    return {rest_, rest_, [&](std::uint32_t one, std::uint32_t other) {
              const std::uint8_t group = object_.face_groups[one];
              return !is_hidden(one) && !is_hidden(other) &&
                     !ignored_.contains(std::minmax(group, object_.face_groups[other]));
            }};
  }
  [[nodiscard]] Expected expected(const oracle::FacePairs& faces) const {
    const oracle::SelfPairs self(rest_, object_.self_rings, object_.self_at_rest ? 0 : threshold());
    const oracle::FacePairs pairs(oracle::SelfRule{
        [&](const Feature& a, const Feature& b) { return self.may(a, b) && faces.may(a, b); },
        [&](const Feature& a, const Feature& b) { return self.may_pierce(a, b) && faces.may(a, b); }});
    Expected expected = expected_of(now_, now_, threshold(), detail_, rest_, rest_, pairs);
    expected.contacts = oracle::each_once(expected.contacts);
    return expected;
  }
  void check(const FrameReport& report, const PairReport* row) const {
    const oracle::FacePairs looked_at = faces();
    if (!looked_at.are_some()) {
      REQUIRE((row != nullptr) == in_contact_);
      if (row != nullptr) REQUIRE(row->phase == PairPhase::ended);
      return;
    }
    const Expected now = expected(looked_at);
    const bool is_somewhere = now.distance.distance_up < std::numeric_limits<double>::max();
    const bool is_near = is_somewhere && is_within(now.distance, std::max(range_of_sheets, threshold()));
    REQUIRE((row != nullptr) == (now.in_contact || in_contact_ || is_near));
    if (row == nullptr) return;
    const PairPhase of_contact = in_contact_ ? PairPhase::touching : PairPhase::began;
    REQUIRE(row->phase == (now.in_contact ? of_contact : in_contact_ ? PairPhase::ended : PairPhase::near));
    const Tolerance tolerance(now_, now_);
    if (is_somewhere)
      REQUIRE(tests::difference_of(row->distance, row->witness, now.distance, tolerance) == "");
    REQUIRE(tests::difference_of(report.contacts(*row), now.contacts, tolerance) == "");
  }

  Random random_;
  ContactDetail detail_;
  Shape rest_;
  Shape now_;
  ObjectSettings object_;
  std::set<std::pair<std::uint8_t, std::uint8_t>> ignored_;
  std::optional<double> rule_;
  bool in_contact_ = false;
  std::vector<Scene> scenes_;
  ObjectId sheet_;
};

}  // namespace

TEST_CASE(
    "self scenes: sheets with calls between steps are those of brute force and of scenes built afresh") {
  for (const ContactDetail detail : all_details) {
    if (!has_self_pairs(detail)) continue;
    std::size_t contacts = 0;
    std::array<std::size_t, 4> phases{};
    for (std::uint64_t seed = 1; seed <= 6 + repeats(18); ++seed) {  // six meet all phases
      INFO("seed " << seed << ", detail " << static_cast<int>(detail));
      SheetScenes scenes(seed, detail);
      for (int step = 0; step < 8; ++step) scenes.step();
      contacts += scenes.contacts;
      for (std::size_t i = 0; i < phases.size(); ++i) phases[i] += scenes.phases[i];
    }
    INFO("detail " << static_cast<int>(detail));
    CHECK((contacts > 0) == (detail != ContactDetail::none));
    CHECK(*std::min_element(phases.begin(), phases.end()) > 0);
  }
}

// Neighbours that are not tested may pierce each other when the surface crumples. At rest nothing tested is
// near.
TEST_CASE("self scenes: coarse balls that crumple are those of scenes built afresh") {
  std::size_t pierced = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const std::uint32_t columns = 3 + random.below(4);
    const auto mesh = mesh_of(shape_of(models::sphere(columns, 1 + random.below(4))));
    ObjectSettings object;
    object.self = true;
    object.self_rings = 1;
    object.self_at_rest = random.chance(0.5);
    const ContactDetail detail = seed % 2 == 0 ? ContactDetail::closest : ContactDetail::none;
    const SceneSettings settings = settings_of(0.2, 2.7, detail);
    Scene kept(settings);
    const ObjectId ball = kept.add(mesh, object);
    for (int step = 0; step < 20; ++step) {
      INFO("seed " << seed << ", step " << step);
      std::vector<Eigen::Vector3d> positions(mesh->rest().begin(), mesh->rest().end());
      if (step % 2 == 1)
        for (Eigen::Vector3d& position : positions) position += random.vector(-0.3, 0.3);
      kept.set_positions(ball, positions);
      Scene afresh(settings);
      afresh.set_positions(afresh.add(mesh, object), positions);
      const ReportHandle report = kept.step();
      REQUIRE(timeless_rows_of(*report, 2.7) == timeless_rows_of(*afresh.step(), 2.7));
      for (const PairReport& row : report->pairs()) pierced += row.distance.upper == 0 ? 1U : 0U;
    }
  }
  CHECK(pierced > 0);
}

TEST_CASE("self scenes: a surface of which no two features are tested has no row, whatever others have") {
  const auto box = mesh_of(models::box({1, 1, 1}));
  for (const ContactDetail detail : all_details) {
    if (!has_self_pairs(detail)) continue;
    INFO("detail " << to_string(detail));
    SceneSettings settings = settings_of(0.25, 4, detail);
    settings.threads = 1;
    Scene scene(settings);
    ObjectSettings object;
    object.self = true;
    object.self_rings = 8;
    const ObjectId first = scene.add(box, object);
    const ObjectId second = scene.add(box, object);
    for (int step = 0; step < 3; ++step) {
      scene.set_positions(second, moved(box->rest(), {1.125, 0.125 * step, 0}));
      const ReportHandle report = scene.step();
      CHECK(report->pairs().size() == 1);
      CHECK(find_pair(*report, first, second) != nullptr);
    }
  }
}

}  // namespace graze::tests
