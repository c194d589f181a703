// Ids are given once and for ever. Pairs come in the order in which their objects were added.

#include <Eigen/Core>
#include <array>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// The pairs' ids in the report's order.
std::vector<std::pair<ObjectId, ObjectId>> pairs_of(const FrameReport& report) {
  std::vector<std::pair<ObjectId, ObjectId>> pairs;
  for (const PairReport& pair : report.pairs()) pairs.emplace_back(pair.a, pair.b);
  return pairs;
}

std::vector<std::pair<ObjectId, ObjectId>> all_pairs_of(const std::vector<ObjectId>& in_order) {
  std::vector<std::pair<ObjectId, ObjectId>> pairs;
  for (std::size_t a = 0; a < in_order.size(); ++a)
    for (std::size_t b = a + 1; b < in_order.size(); ++b) pairs.emplace_back(in_order[a], in_order[b]);
  return pairs;
}

template <typename Points>
concept Bindable = requires(Scene& scene, ObjectId id, Points&& points) {
  scene.bind_positions(id, std::forward<Points>(points));
};
// Memory that ends with the call cannot be bound. Views and what stays can.
static_assert(!Bindable<Positions> && !Bindable<const Positions> &&
              !Bindable<std::array<Eigen::Vector3f, 3>>);
static_assert(!Bindable<Eigen::MatrixXd> && !Bindable<Eigen::Matrix3Xf>);
static_assert(Bindable<Positions&> && Bindable<const Positions&> && Bindable<Eigen::MatrixXd&>);
static_assert(Bindable<PositionView> && Bindable<std::span<const Eigen::Vector3d>>);
static_assert(Bindable<Eigen::Map<const Eigen::MatrixXd>>);

}  // namespace

TEST_CASE("every call on an id that names nothing leaves one diagnostic with that id") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  Scene& scene = pair.scene;
  const ObjectId nothing;
  const ObjectId never_given{77, 1};
  const ObjectId other_generation{pair.needle.index, pair.needle.generation + 1};
  const Positions positions = lifted(*needle_mesh(), 3);
  for (const ObjectId bad : {nothing, never_given, other_generation}) {
    CHECK_FALSE(scene.contains(bad));
    CHECK(scene.mesh(bad) == nullptr);
    CHECK(scene.object_settings(bad).name.empty());
    CHECK(scene.name(bad).empty());
    scene.remove(bad);
    scene.set_pose(bad, lift_pose(1));
    scene.set_positions(bad, positions);
    scene.bind_positions(bad, positions);
    scene.unbind_positions(bad);
    scene.positions_changed(bad);
    scene.ignore(bad, pair.needle);
    scene.ignore(pair.needle, bad);
    scene.watch(bad, pair.needle);
    scene.watch(pair.needle, bad);
    const ReportHandle report = scene.step();
    CHECK(kinds_of(*report) == std::vector(10, DiagnosticKind::stale_id));
    for (const Diagnostic& diagnostic : report->diagnostics()) {
      CHECK(diagnostic.object == bad);
      CHECK_FALSE(diagnostic.message.empty());
    }
    CHECK(only_pair(*report).distance.upper == 0);  // nothing was moved, nothing filtered out
    CHECK(scene.object_count() == 2);
    CHECK(scene.step()->diagnostics().empty());
  }
}

TEST_CASE("an object is removed once") {
  NeedleOverPlate pair(settings_of(0.5, 1));
  pair.scene.remove(pair.needle);
  pair.scene.remove(pair.needle);
  CHECK(pair.scene.object_count() == 1);
  const ReportHandle report = pair.scene.step();
  REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::stale_id});
  CHECK(report->diagnostics()[0].object == pair.needle);
}

TEST_CASE("an id that is given again names another object") {
  Scene scene(settings_of(0.5, 1));
  ObjectSettings settings;
  settings.name = "first";
  const ObjectId first = scene.add(needle_mesh(), settings);
  const ObjectId plate = scene.add(plate_mesh());
  scene.ignore(first, plate);
  scene.step();
  scene.remove(first);
  settings.name = "second";
  const ObjectId second = scene.add(needle_mesh(), settings);
  CHECK(first != second);
  CHECK_FALSE(scene.contains(first));
  CHECK(scene.contains(second));
  CHECK(scene.object_settings(second).name == "second");
  CHECK(scene.name(second) == "second");

  // The second object must not get anything that is said of the first: neither the pair ignored before, nor
  // the positions set now.
  scene.set_positions(first, lifted(*needle_mesh(), 9));
  const ReportHandle report = scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::stale_id});
  CHECK(only_pair(*report).a == plate);
  CHECK(only_pair(*report).b == second);
  CHECK(only_pair(*report).phase == PairPhase::began);
  CHECK(only_pair(*report).distance.upper == 0);
}

TEST_CASE("no id is given twice") {
  Scene scene(settings_of(0, 0));
  const auto mesh = needle_mesh();
  std::set<ObjectId> given;
  std::vector<ObjectId> alive;
  for (std::size_t round = 0; round < 3000; ++round) {
    const ObjectId id = scene.add(mesh);
    REQUIRE(given.insert(id).second);
    REQUIRE(id.generation != 0);
    alive.push_back(id);
    if (round % 3 != 0) {
      scene.remove(alive[round % alive.size()]);
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(round % alive.size()));
    }
    REQUIRE(scene.object_count() == alive.size());
  }
  for (const ObjectId id : given)
    REQUIRE(scene.contains(id) == (std::find(alive.begin(), alive.end(), id) != alive.end()));
}

TEST_CASE("pairs are sorted by the order of addition, also where indices are used again") {
  Scene scene(settings_of(0, 100, ContactDetail::none));
  const auto mesh = plate_mesh();
  std::vector<ObjectId> in_order;
  const auto add = [&] {
    in_order.push_back(scene.add(mesh));
    scene.set_positions(in_order.back(), lifted(*mesh, static_cast<double>((in_order.size() * 7) % 11)));
  };
  const auto remove = [&](std::size_t place) {
    scene.remove(in_order[place]);
    in_order.erase(in_order.begin() + static_cast<std::ptrdiff_t>(place));
  };
  for (int i = 0; i < 6; ++i) add();
  CHECK(pairs_of(*scene.step()) == all_pairs_of(in_order));
  remove(1);
  remove(3);
  CHECK(pairs_of(*scene.step()) == all_pairs_of(in_order));
  add();
  add();
  remove(0);
  add();
  CHECK(pairs_of(*scene.step()) == all_pairs_of(in_order));
  CHECK(scene.step()->statistics().pairs_total == all_pairs_of(in_order).size());
}

TEST_CASE("a removed object's pair in contact ends, and another object's contact begins") {
  NeedleOverPlate pair(settings_of(0.5, 10));
  CHECK(only_pair(*pair.step_at(0.25)).phase == PairPhase::began);
  pair.scene.remove(pair.needle);
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::ended);
  CHECK(pair.scene.step()->pairs().empty());

  const ObjectId again = pair.scene.add(needle_mesh());
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::began);
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::touching);
  // Removed and replaced between two steps: the newcomer's contact begins.
  pair.scene.remove(again);
  const ObjectId newcomer = pair.scene.add(needle_mesh());
  const ReportHandle report = pair.scene.step();
  REQUIRE(report->pairs().size() == 2);
  CHECK(report->pairs()[0].b == again);
  CHECK(report->pairs()[0].phase == PairPhase::ended);
  CHECK(report->pairs()[1].b == newcomer);
  CHECK(report->pairs()[1].phase == PairPhase::began);
}

TEST_CASE("an object that was added and removed between two steps was never there") {
  Scene scene(settings_of(0.5, 1));
  scene.add(plate_mesh());
  const ObjectId brief = scene.add(needle_mesh());
  scene.set_positions(brief, lifted(*needle_mesh(), 0.25));
  scene.remove(brief);
  CHECK(scene.object_count() == 1);
  const ReportHandle report = scene.step();
  CHECK(report->pairs().empty());
  CHECK(report->diagnostics().empty());
  CHECK(report->statistics().objects == 1);
}

TEST_CASE("a scene tells what an object was added with") {
  Scene scene(settings_of(0, 0));
  const auto mesh = plate_mesh();
  ObjectSettings settings;
  settings.name = "plate";
  settings.motion = Motion::rigid;
  settings.layer = 4;
  settings.collides_with = 9;
  settings.margin = 0.125;
  settings.kind = 255;
  settings.user_data = 42;
  const ObjectId id = scene.add(mesh, settings);
  CHECK(scene.mesh(id) == mesh);
  const ObjectSettings told = scene.object_settings(id);
  CHECK(told.name == "plate");
  CHECK(told.motion == Motion::rigid);
  CHECK(told.layer == 4);
  CHECK(told.collides_with == 9);
  CHECK(told.margin == 0.125);
  CHECK(told.kind == 255);
  CHECK(told.user_data == 42);
  CHECK(scene.settings().threads == 1);
}

TEST_CASE("the library is of the version of its headers") {
  CHECK(library_version() == header_version);
}

}  // namespace graze::tests
