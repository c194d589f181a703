// Objects in bound memory that are far from everything: their boxes are all that a step makes of them, and
// nothing of it shows.

#include <algorithm>
#include <limits>
#include <string>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Plates in bound memory, each over its own place, 10 apart.
struct Field {
  static constexpr std::size_t count = 6;

  explicit Field(unsigned threads = 1) : scene(with_threads(threads)) {
    for (std::size_t i = 0; i < count; ++i) {
      memory[i] = at(i, {0, 0, 0});
      ids[i] = scene.add(plate_mesh());
      scene.bind_positions(ids[i], memory[i]);
    }
  }
  static SceneSettings with_threads(unsigned threads) {
    SceneSettings settings = settings_of(0.5, 1);
    settings.threads = threads;
    return settings;
  }
  static Positions at(std::size_t place, const Eigen::Vector3d& by) {
    return moved(plate_mesh()->rest(), by + Eigen::Vector3d(10 * static_cast<double>(place), 0, 0));
  }
  void put(std::size_t place, const Eigen::Vector3d& by) {
    const Positions now = at(place, by);
    std::copy(now.begin(), now.end(), memory[place].begin());
  }
  /// All in some new place near their own, for the next steps to survey.
  void drift() {
    ++drifted;
    for (std::size_t i = 0; i < count; ++i) put(i, {0, 0, 0.01 * drifted});
  }
  ReportHandle surveyed() {
    for (int step = 0; step < 3; ++step) {
      drift();
      last = scene.step();
    }
    CHECK(last->statistics().objects_surveyed == count);
    return last;
  }

  Scene scene;
  std::array<Positions, count> memory;
  std::array<ObjectId, count> ids;
  int drifted = 0;
  ReportHandle last;
};

}  // namespace

TEST_CASE("survey: what is far is surveyed, and read when it comes near") {
  Field field;
  const auto surveyed_in_next = [&] { return field.scene.step()->statistics().objects_surveyed; };
  CHECK(surveyed_in_next() == Field::count);
  CHECK(surveyed_in_next() == Field::count);
  field.drift();
  CHECK(surveyed_in_next() == Field::count);
  for (const double gap : {0.75, 0.25, 0.5, 0.125}) {
    field.put(1, {-10, 0, gap + 0.01 * field.drifted});
    const ReportHandle report = field.scene.step();
    REQUIRE(report->diagnostics().empty());
    REQUIRE(report->pairs().size() == 1);
    CHECK(report->pairs()[0].distance.upper == Approx(gap).epsilon(1e-12));
    CHECK(report->contacts(report->pairs()[0]).empty() == !(gap < 0.5));
    CHECK(report->statistics().objects_surveyed == (gap == 0.75 ? Field::count : Field::count - 2));
  }
  field.put(1, {0, 0, 0});
  CHECK(only_pair(*field.scene.step()).phase == PairPhase::ended);
  CHECK(field.scene.step()->pairs().empty());
  // It has not moved since it was read last.
  CHECK(field.scene.step()->statistics().objects_surveyed == Field::count - 2);
}

TEST_CASE("survey: unbound memory leaves the object where it was at the call, near or far") {
  Field field;
  field.surveyed();
  for (const std::size_t place : {1U, 2U}) {
    field.put(place, {0, 3, 7.0 + static_cast<double>(place)});
    field.scene.unbind_positions(field.ids[place]);
    field.memory[place].assign(field.memory[place].size(), {-1, -1, -1});
    field.memory[place] = Positions();
  }
  CHECK(field.scene.step()->pairs().empty());
  field.put(0, {10, 3, 8.25});
  const ReportHandle report = field.scene.step();
  CHECK(report->diagnostics().empty());
  REQUIRE(report->pairs().size() == 1);
  CHECK(report->pairs()[0].distance.upper == 0.25);
}

TEST_CASE("survey: a binding that is taken back before a step is where its memory was") {
  Field field;
  field.surveyed();
  Positions other = Field::at(1, {-10, 3, 4});
  const ObjectId object = field.ids[1];
  SECTION("copied, bound again and unbound") {
    field.scene.unbind_positions(object);
    field.scene.set_positions(object, Field::at(1, {0, 0, 9}));
    field.scene.bind_positions(object, other, BindPolicy::when_told);
    field.scene.unbind_positions(object);
    other = Positions();
  }
  SECTION("bound again, read, and unbound") {
    field.scene.bind_positions(object, other, BindPolicy::when_told);
    field.scene.step();
    other[0].x() = 100;
    field.scene.unbind_positions(object);
    other = Positions();
  }
  SECTION("bound again to bad memory, which was never read when it was good") {
    const Eigen::Vector3d good = other[0];
    other[0].x() = std::numeric_limits<double>::infinity();
    field.scene.bind_positions(object, other, BindPolicy::when_told);
    CHECK(kinds_of(*field.scene.step()) == std::vector{DiagnosticKind::not_finite});
    field.scene.unbind_positions(object);
    field.put(0, {0, 3, 3.75});
    const ReportHandle frozen = field.scene.step();
    // No step has read what it was told of.
    CHECK(kinds_of(*frozen) == std::vector{DiagnosticKind::not_finite});
    CHECK(frozen->pairs().empty());
    other[0] = good;
    field.scene.set_positions(object, other);
  }
  field.put(0, {0, 3, 3.75});
  const ReportHandle report = field.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(only_pair(*report).distance.upper == 0.25);
}

TEST_CASE("survey: one call of positions_changed before the first step is not a second one in a row") {
  Scene scene(settings_of(0.5, 1));
  Positions memory = Field::at(0, {0, 0, 0.25});
  const ObjectId plate = scene.add(plate_mesh());
  scene.bind_positions(plate, memory, BindPolicy::when_told);
  scene.positions_changed(plate);
  CHECK(scene.step()->statistics().objects_surveyed == 0);
  // No call tells of this, so the plate stays where the first step read it.
  const Positions elsewhere = Field::at(0, {0, 0, 0.75});
  std::copy(elsewhere.begin(), elsewhere.end(), memory.begin());
  scene.add(plate_mesh());
  const ReportHandle report = scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(only_pair(*report).distance.upper == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("survey: bad memory freezes what is far too, until it is good") {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Field field;
  field.surveyed();
  field.memory[3][2].y() = nothing;
  for (int step = 0; step < 3; ++step) {
    const ReportHandle report = field.scene.step();
    REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
    CHECK(report->diagnostics()[0].object == field.ids[3]);
    CHECK(report->diagnostics()[0].message.find("vertex 2") != std::string::npos);
  }
  SECTION("good again, and at once near another") {
    field.put(3, {-10, 0, 0.25 + 0.01 * field.drifted});
    const ReportHandle report = field.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(only_pair(*report).distance.upper == Approx(0.25).epsilon(1e-12));
  }
  SECTION("unbound: it stands still until it is given good positions") {
    field.scene.unbind_positions(field.ids[3]);
    field.memory[3] = Positions();
    CHECK(kinds_of(*field.scene.step()) == std::vector{DiagnosticKind::not_finite});
    field.put(2, {10, 0, 0.25});
    const ReportHandle frozen = field.scene.step();
    CHECK(frozen->diagnostics().empty());
    CHECK(frozen->pairs().empty());
    field.scene.unbind_positions(field.ids[3]);
    CHECK(field.scene.step()->pairs().empty());
    field.scene.set_positions(field.ids[3], Field::at(3, {0, 0, 0.5}));
    CHECK(only_pair(*field.scene.step()).distance.upper == 0.25);
  }
}

TEST_CASE("survey: large surfaces are surveyed and read in parts") {
  const auto mesh = mesh_of(models::sheet(100, 100, 4, 4));
  const Positions rest(mesh->rest().begin(), mesh->rest().end());
  Scene scene(settings_of(0.25, 1));
  const ObjectId low = scene.add(mesh);
  const ObjectId high = scene.add(mesh);
  Positions memory = rest;
  const auto step_at = [&](double height) {
    const Positions now = moved(rest, {0, 0, height});
    std::copy(now.begin(), now.end(), memory.begin());
    return scene.step();
  };
  scene.bind_positions(high, memory);
  for (const double height : {8.0, 7.0, 6.0}) CHECK(step_at(height)->pairs().empty());
  CHECK(scene.latest_report()->statistics().objects_surveyed == 1);
  const ReportHandle near = step_at(0.5);
  CHECK(near->statistics().objects_surveyed == 1);
  REQUIRE(find_pair(*near, low, high) != nullptr);
  CHECK(find_pair(*near, low, high)->distance.upper == 0.5);
  CHECK(step_at(0.125)->statistics().objects_surveyed == 0);
  for (const double height : {5.0, 6.0, 7.0, 8.0}) step_at(height);
  CHECK(scene.latest_report()->statistics().objects_surveyed == 1);
  memory.back().x() = std::numeric_limits<double>::quiet_NaN();
  const ReportHandle bad = scene.step();
  REQUIRE(kinds_of(*bad) == std::vector{DiagnosticKind::not_finite});
  CHECK(bad->diagnostics()[0].message.find("vertex " + std::to_string(rest.size() - 1)) != std::string::npos);
  CHECK(step_at(0.5)->diagnostics().empty());
  CHECK(find_pair(*scene.latest_report(), low, high)->distance.upper == 0.5);
}

TEST_CASE("survey: promises are held against what was seen") {
  Field field;
  field.surveyed();
  // A survey saw where its box is, so that a promise about it is enough. With validators on all is read.
  field.put(4, {0, 0, 2});
  field.scene.positions_changed(field.ids[4], 3);
  ReportHandle report = field.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(report->statistics().objects_unread <= 1);
  CHECK(report->statistics().objects_surveyed == Field::count - 1);
  field.put(4, {0, 0, 4});
  field.scene.positions_changed(field.ids[4], 3);
  report = field.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(report->statistics().objects_surveyed == Field::count - 1);
  // Something comes near where it should be, so that it is read and the broken promise seen.
  field.put(4, {-10, 0, 0.25});
  field.scene.positions_changed(field.ids[4], 1);
  field.put(3, {10, 0, 4.25});
  report = field.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::broken_promise});
  CHECK(report->pairs().empty());
}

TEST_CASE("survey: the first promise is held against the box that the first step saw") {
  const auto step_with = [](const Eigen::Vector3d& to, double promise) {
    Field field;
    field.scene.step();
    field.put(1, to);
    field.scene.positions_changed(field.ids[1], promise);
    // Beside where it should be, so that it is read.
    field.put(0, {10, 0, 1.25});
    return field.scene.step();
  };
  const ReportHandle kept = step_with({0, 0, 0.5}, 0.5);
  CHECK(kept->diagnostics().empty());
  REQUIRE(kept->pairs().size() == 1);
  CHECK(kept->pairs()[0].distance.upper == 0.75);
  CHECK(kinds_of(*step_with({0, 0, 0.5}, 0.49)) == std::vector{DiagnosticKind::broken_promise});
  const ReportHandle gone = step_with({0, 40, 0}, 1);
  CHECK(kinds_of(*gone) == std::vector{DiagnosticKind::broken_promise});
  CHECK(gone->pairs().empty());
}

TEST_CASE("survey: any way of moving gives the reports of a scene built afresh, on any number of threads") {
  oracle::Random random(23);
  std::array<Field, 2> fields{Field(1), Field(2)};
  std::size_t surveyed = 0;
  std::size_t near = 0;
  std::array<Eigen::Vector3d, Field::count> by{};
  for (Eigen::Vector3d& way : by) way.setZero();
  for (int step = 0; step < 300; ++step) {
    for (std::size_t i = 0; i < Field::count; ++i) {
      if (random.chance(0.3)) by[i][2] += 0.001 * random.below(100);
      if (random.chance(0.05)) by[i] = {10.0 * random.below(3) - 10, 0, 0.5 * random.below(3)};
      if (random.chance(0.2)) by[i] = {0, 0, 0};
      for (Field& field : fields) field.put(i, by[i]);
    }
    const std::size_t unbound = random.chance(0.1) ? random.below(Field::count) : Field::count;
    if (unbound < Field::count)
      for (Field& field : fields) {
        field.scene.unbind_positions(field.ids[unbound]);
        field.scene.bind_positions(field.ids[unbound], field.memory[unbound],
                                   step % 2 == 0 ? BindPolicy::every_step : BindPolicy::when_told);
        field.scene.positions_changed(field.ids[unbound]);
      }
    for (Field& field : fields)
      for (const ObjectId id : field.ids) field.scene.positions_changed(id);
    const ReportHandle report = fields[0].scene.step();
    REQUIRE(difference_of(*fields[1].scene.step(), *report).empty());
    surveyed += report->statistics().objects_surveyed;
    near += report->pairs().size();
    Field fresh;
    for (std::size_t i = 0; i < Field::count; ++i) fresh.put(i, by[i]);
    REQUIRE(timeless_rows_of(*report, 1) == timeless_rows_of(*fresh.scene.step(), 1));
  }
  CHECK(surveyed > 300);
  CHECK(near > 100);
}

}  // namespace graze::tests
