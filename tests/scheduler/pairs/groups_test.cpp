// Face groups in scenes: random scenes with calls between steps against brute force, phases, rest, wrong
// calls, and what is remembered of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <graze/error.hpp>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pairs/ignored_groups.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

/// Two shapes in two scenes, of one thread and of two, and what the calls on both say so far.
class GroupedScenes {
 public:
  GroupedScenes(std::uint64_t seed, ContactDetail detail)
      : random_(seed),
        given_(oracle::random_scene(seed)),
        detail_(detail),
        group_count_(1 + static_cast<std::uint32_t>(seed / 2 % 3)),
        range_(seed % 3 == 0 ? std::numeric_limits<double>::infinity() : 1),
        a_(given_.a),
        b_(given_.b) {
    ObjectSettings settings_a;
    ObjectSettings settings_b;
    settings_a.face_groups = groups_a_ = random_groups(a_.faces.size());
    settings_b.face_groups = groups_b_ = random_groups(b_.faces.size());
    for (const unsigned threads : {1U, 2U}) {
      SceneSettings settings = settings_of(given_.threshold, range_, detail);
      settings.threads = threads;
      Scene& scene = scenes_.emplace_back(settings);
      id_a_ = scene.add(mesh_of(given_.a), settings_a);
      id_b_ = scene.add(mesh_of(given_.b), settings_b);
    }
    change_groups();
    change_groups();
  }

  /// Makes some calls, steps, and compares the row with brute force.
  void step() {
    if (random_.chance(0.6)) move();
    if (random_.chance(0.6)) change_groups();
    if (random_.chance(0.1)) change_pair();
    const ReportHandle report = scenes_[0].step();
    REQUIRE(inconsistency_of(*report) == "");
    REQUIRE(difference_of(*report, *scenes_[1].step()) == "");
    check(*report);
    ++steps;
    contacts += report->contacts().size();
  }

  std::size_t steps = 0;
  std::size_t contacts = 0;
  std::size_t ended_by_groups = 0;

 private:
  using Groups = std::vector<std::uint8_t>;

  Groups random_groups(std::size_t face_count) {
    Groups groups;
    for (std::size_t face = 0; face < face_count; ++face)
      groups.push_back(static_cast<std::uint8_t>(random_.below(group_count_)));
    return groups;
  }
  void change_groups() {
    const auto group_a = static_cast<std::uint8_t>(random_.below(group_count_));
    const auto group_b = static_cast<std::uint8_t>(random_.below(group_count_));
    const bool ignored = random_.chance(0.7);
    const bool reversed = random_.chance(0.5);
    for (Scene& scene : scenes_) {
      if (ignored && reversed) scene.ignore(id_b_, group_b, id_a_, group_a);
      if (ignored && !reversed) scene.ignore(id_a_, group_a, id_b_, group_b);
      if (!ignored && reversed) scene.watch(id_b_, group_b, id_a_, group_a);
      if (!ignored && !reversed) scene.watch(id_a_, group_a, id_b_, group_b);
    }
    if (ignored)
      ignored_.insert({group_a, group_b});
    else
      ignored_.erase({group_a, group_b});
  }
  void change_pair() {
    is_ignored_ = !is_ignored_;
    for (Scene& scene : scenes_) is_ignored_ ? scene.ignore(id_a_, id_b_) : scene.watch(id_a_, id_b_);
  }
  void move() {
    const double size = random_.chance(0.5) ? 0.03125 : 0.5;
    const Eigen::Vector3d way = random_.vector(-size, size);
    for (Eigen::Vector3d& position : b_.positions) position += way;
    for (Scene& scene : scenes_) scene.set_positions(id_b_, b_.positions);
  }

  [[nodiscard]] oracle::FacePairs pairs() const {
    return {a_, b_, [&](std::uint32_t face_a, std::uint32_t face_b) {
              return !ignored_.contains({groups_a_[face_a], groups_b_[face_b]});
            }};
  }
  [[nodiscard]] Expected expected(const oracle::FacePairs& looked_at) const {
    return expected_of(a_, b_, given_.threshold, detail_, given_.a, given_.b, looked_at);
  }

  void check(const FrameReport& report) {
    const bool was_in_contact = std::exchange(in_contact_, false);
    const PairReport* const row = find_pair(report, id_a_, id_b_);
    const oracle::FacePairs looked_at = pairs();
    const bool is_filtered = is_ignored_ || !looked_at.are_some();
    if (is_filtered) {
      // A pair that was in contact ends with its distance: of all, where groups leave nothing.
      REQUIRE((row != nullptr) == was_in_contact);
      if (row == nullptr) return;
      ended_by_groups += is_ignored_ ? 0U : 1U;
      check_row(report, *row, expected(looked_at.are_some() ? looked_at : oracle::FacePairs()),
                PairPhase::ended);
      return;
    }
    const Expected now = expected(looked_at);
    in_contact_ = now.in_contact;
    const bool listed =
        in_contact_ || was_in_contact || is_within(now.distance, std::max(range_, given_.threshold));
    REQUIRE((row != nullptr) == listed);
    if (row == nullptr) return;
    const PairPhase phase = in_contact_ ? (was_in_contact ? PairPhase::touching : PairPhase::began)
                                        : (was_in_contact ? PairPhase::ended : PairPhase::near);
    check_row(report, *row, now, phase);
    REQUIRE(tests::difference_of(report.contacts(*row), now.contacts, {a_, b_}) == "");
  }
  void check_row(const FrameReport& report, const PairReport& row, const Expected& now,
                 PairPhase phase) const {
    REQUIRE(row.phase == phase);
    REQUIRE(tests::difference_of(row.distance, row.witness, now.distance, {a_, b_}) == "");
    if (phase == PairPhase::ended) REQUIRE(report.contacts(row).empty());
  }

  Random random_;
  oracle::RandomScene given_;
  ContactDetail detail_;
  std::uint32_t group_count_;
  double range_;
  Shape a_;
  Shape b_;
  Groups groups_a_;
  Groups groups_b_;
  std::set<std::pair<std::uint8_t, std::uint8_t>> ignored_;
  bool is_ignored_ = false;
  bool in_contact_ = false;
  std::vector<Scene> scenes_;
  ObjectId id_a_;
  ObjectId id_b_;
};

/// The plate of two triangles: group 0 has the corner (1, -1), group 5 the corner (-1, 1).
std::shared_ptr<const Mesh> split_plate() {
  constexpr std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(plate_mesh()->rest(), triangles));
}

/// A needle whose tip stands 0.25 above the middle of one of a plate's two triangles.
struct NeedleOverSplitPlate {
  explicit NeedleOverSplitPlate(ContactDetail detail = ContactDetail::features)
      : scene(settings_of(0.5, 1, detail)) {
    ObjectSettings settings;
    settings.face_groups = {0, 5};
    plate = scene.add(split_plate(), settings);
    needle = scene.add(needle_mesh());
    scene.set_positions(needle, lifted(*needle_mesh(), 0.25));
  }

  Scene scene;
  ObjectId plate, needle;
};

std::string message_of_add(std::vector<std::uint8_t> groups) {
  Scene scene;
  ObjectSettings settings;
  settings.name = "cloth";
  settings.face_groups = std::move(groups);
  try {
    scene.add(split_plate(), settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("face groups: scenes with calls between steps are those of brute force") {
  std::size_t steps = 0;
  std::size_t contacts = 0;
  std::size_t ended_by_groups = 0;
  for (std::uint64_t seed = 1; seed < 140; seed += 2) {
    for (const ContactDetail detail : all_details) {
      INFO("seed " << seed << ", detail " << static_cast<int>(detail));
      GroupedScenes scenes(seed, detail);
      for (int step = 0; step < 8; ++step) scenes.step();
      steps += scenes.steps;
      contacts += scenes.contacts;
      ended_by_groups += scenes.ended_by_groups;
    }
  }
  CHECK(steps == 70 * all_details.size() * 8);
  CHECK(contacts > 1000);
  CHECK(ended_by_groups > 10);
}

TEST_CASE("face groups: a pair at rest is searched again when groups change") {
  NeedleOverSplitPlate stage;
  const auto distance = [](const ReportHandle& report) { return only_pair(*report).distance.upper; };
  CHECK(distance(stage.scene.step()) == 0.25);
  for (int step = 0; step < 3; ++step) stage.scene.step();
  // The tip is over the second face, at (0.25, 0.5). The diagonal is nearest then, 0.25 / sqrt(2) beside it.
  stage.scene.ignore(stage.needle, 0, stage.plate, 5);
  const ReportHandle without = stage.scene.step();
  CHECK(only_pair(*without).phase == PairPhase::touching);
  CHECK(distance(without) == Approx(std::sqrt(0.0625 + 0.03125)));
  REQUIRE(without->contacts().size() == 1);
  CHECK(without->contacts()[0].kind == ContactKind::VE);
  CHECK(distance(stage.scene.step()) == distance(without));
  stage.scene.watch(stage.plate, 5, stage.needle, 0);
  CHECK(distance(stage.scene.step()) == 0.25);
}

TEST_CASE("face groups: a pair of which nothing is left ends as an ignored one") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverSplitPlate stage(detail);
    CHECK(only_pair(*stage.scene.step()).phase == PairPhase::began);
    stage.scene.ignore(stage.plate, 0, stage.needle, 0);
    CHECK(only_pair(*stage.scene.step()).phase == PairPhase::touching);
    stage.scene.ignore(stage.plate, 5, stage.needle, 0);
    const ReportHandle ended = stage.scene.step();
    CHECK(only_pair(*ended).phase == PairPhase::ended);
    CHECK(only_pair(*ended).distance.upper == 0.25);
    CHECK(ended->contacts().empty());
    CHECK(ended->statistics().pairs_ignored == 1);
    CHECK(stage.scene.step()->pairs().empty());
    // A pair that is ignored as a whole is another rule.
    stage.scene.watch(stage.plate, stage.needle);
    CHECK(stage.scene.step()->pairs().empty());
    stage.scene.watch(stage.plate, 5, stage.needle, 0);
    CHECK(only_pair(*stage.scene.step()).phase == PairPhase::began);
  }
}

TEST_CASE("face groups: groups without faces, and groups of one object, change nothing") {
  NeedleOverSplitPlate stage;
  stage.scene.ignore(stage.plate, 7, stage.needle, 0);
  stage.scene.ignore(stage.plate, 0, stage.needle, 255);
  stage.scene.ignore(stage.plate, 0, stage.plate, 5);
  stage.scene.watch(stage.plate, 5, stage.plate, 0);
  const ReportHandle report = stage.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(only_pair(*report).distance.upper == 0.25);
  CHECK(stage.scene.object_settings(stage.plate).face_groups == std::vector<std::uint8_t>{0, 5});
}

TEST_CASE("face groups: wrong groups throw, and stale ids are told") {
  CHECK(message_of_add({}) == "");
  CHECK(message_of_add({1, 2}) == "");
  CHECK(message_of_add({1}) ==
        "object 'cloth': face_groups has 1 groups for 2 faces; give one for each face, or none");
  CHECK(message_of_add({1, 2, 3}) != "");
  NeedleOverSplitPlate stage;
  stage.scene.remove(stage.needle);
  stage.scene.ignore(stage.plate, 0, stage.needle, 0);
  stage.scene.watch(stage.needle, 0, stage.plate, 0);
  const ReportHandle report = stage.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::stale_id, DiagnosticKind::stale_id});
  CHECK(report->diagnostics()[1].message.starts_with("watch: id "));
}

TEST_CASE("face groups: what is ignored is known by both objects until one is gone") {
  Object a;
  Object b;
  a.serial = 3;
  b.serial = 9;
  IgnoredGroups groups;
  ChangedPairs changed;
  groups.set(a, 1, b, 2, false, changed);
  CHECK(groups.is_empty());
  groups.set(b, 2, a, 1, true, changed);
  groups.set(a, 4, a, 6, true, changed);
  std::vector<std::array<std::uint64_t, 4>> known;
  groups.visit(
      [&](std::uint64_t serial_a, std::uint8_t group_a, std::uint64_t serial_b, std::uint8_t group_b) {
        known.push_back({serial_a, group_a, serial_b, group_b});
      });
  CHECK(known == std::vector<std::array<std::uint64_t, 4>>{{3, 4, 3, 6}, {3, 1, 9, 2}});
  const std::uint64_t version = groups.of(3, 9).version;
  CHECK(version > 0);
  groups.set(a, 0, b, 0, true, changed);  // all of their faces are in group 0
  CHECK(groups.ignores_all(3, 9));
  CHECK(groups.of(3, 9).version > version);
  CHECK(groups.of(3, 8).version == 0);
  const auto mesh = split_plate();
  b.face_groups = std::make_shared<const FaceGroups>(indexed(*mesh), std::vector<std::uint8_t>{2, 0});
  const std::uint64_t before = groups.of(3, 9).version;
  groups.regroup(b.serial, b.face_groups, changed);  // another mesh, with a face of which nothing is ignored
  CHECK_FALSE(groups.ignores_all(3, 9));
  CHECK(groups.of(3, 9).version > before);
  CHECK_FALSE(groups.of(3, 9).filter->may_vertices(0, 3));
  CHECK(groups.of(3, 9).filter->may_vertices(0, 1));
  groups.forget(9);
  CHECK_FALSE(groups.ignores_all(3, 9));
  CHECK_FALSE(groups.is_empty());
  groups.forget(3);
  CHECK(groups.is_empty());
}

}  // namespace graze::tests
