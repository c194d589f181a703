// This test checks promises of motion by the caller. They must save work and never change an answer.

#include <limits>

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::vector<Eigen::Vector3f> floats_of(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3f> floats;
  for (const Eigen::Vector3d& point : points) floats.push_back(point.cast<float>());
  return floats;
}

/// A row of plates, 4 apart, all in bound memory.
struct Row {
  explicit Row(BindPolicy policy) : scene(settings_of(0.25, 1)) {
    for (int i = 0; i < 20; ++i) {
      memory.push_back(floats_of(moved(plate_mesh()->rest(), {0, 0, 4.0 * i})));
      ids.push_back(scene.add(plate_mesh()));
      scene.bind_positions(ids.back(), memory.back(), policy);
    }
    scene.step();
  }
  void lift(std::size_t plate, float by) {
    for (Eigen::Vector3f& point : memory[plate]) point.z() += by;
  }
  ReportHandle afresh() const {
    Scene fresh(scene.settings());
    for (const auto& positions : memory) fresh.bind_positions(fresh.add(plate_mesh()), positions);
    return fresh.step();
  }

  Scene scene;
  std::vector<std::vector<Eigen::Vector3f>> memory;
  std::vector<ObjectId> ids;
};

}  // namespace

TEST_CASE("a promise about an object that no step has seen does not leave it unread") {
  // Everything starts where the meshes rest, one upon the other, and is bound elsewhere.
  std::vector<std::vector<Eigen::Vector3f>> memory;
  for (int i = 0; i < 6; ++i) memory.push_back(floats_of(moved(plate_mesh()->rest(), {0, 0, 4.0 * i})));
  const auto first_step = [&](double promise) {
    Scene scene(settings_of(0.25, 1));
    for (const auto& positions : memory) {
      const ObjectId id = scene.add(plate_mesh());
      scene.bind_positions(id, positions, BindPolicy::when_told);
      scene.positions_changed(id, promise);
    }
    return scene.step();
  };
  const ReportHandle report = first_step(0.0625);
  CHECK(report->diagnostics().empty());
  CHECK(report->pairs().empty());
  CHECK(report->statistics().objects_unread == 0);
  const double none = std::numeric_limits<double>::infinity();
  CHECK(report->statistics().work.boxes_tested == first_step(none)->statistics().work.boxes_tested);
}

TEST_CASE("what promises say is far is not read") {
  for (const BindPolicy policy : {BindPolicy::every_step, BindPolicy::when_told}) {
    Row row(policy);
    for (const ObjectId id : row.ids) row.scene.positions_changed(id, 0.125);
    row.memory[7][0].x() = nan;
    const ReportHandle report = row.scene.step();
    // With validators on everything is read, and the NaN is found. Otherwise nothing is.
    const bool reads_all = report->statistics().objects_unread == 0;
    CHECK(report->statistics().objects_unread == (reads_all ? 0U : 20U));
    CHECK(report->diagnostics().size() == (reads_all ? 1U : 0U));
    CHECK(report->pairs().empty());
  }
}

TEST_CASE("promises add up until what they allow may be near") {
  Row row(BindPolicy::when_told);
  std::size_t unread = 0;
  bool near = false;
  for (int step = 0; step < 40; ++step) {
    for (std::size_t plate : {std::size_t{3}, std::size_t{12}}) {
      row.lift(plate, 0.09375F);
      row.scene.positions_changed(row.ids[plate], 0.09375);
    }
    const ReportHandle report = row.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(timeless_rows_of(*report, 1) == timeless_rows_of(*row.afresh(), 1));
    unread += report->statistics().objects_unread;
    near = near || !report->pairs().empty();
  }
  CHECK(near);
  CHECK((unread == 0 || unread > 20));  // none with validators on
}

TEST_CASE("a promise that is broken is told when it is seen, whatever lay in between") {
  const auto policy = GENERATE(BindPolicy::every_step, BindPolicy::when_told);
  Row row(policy);
  row.lift(5, 3.5F);  // next to its neighbour
  row.scene.positions_changed(row.ids[5], 0.5);
  std::size_t broken = row.scene.step()->diagnostics().size();
  for (int step = 0; step < 8; ++step) {
    row.scene.positions_changed(row.ids[5], 0.5);
    for (const Diagnostic& diagnostic : row.scene.step()->diagnostics()) {
      CHECK(diagnostic.kind == DiagnosticKind::broken_promise);
      CHECK(diagnostic.object == row.ids[5]);
      ++broken;
    }
  }
  CHECK(broken == 1);
}

TEST_CASE("copies with a promise wait too, and the later one counts") {
  Scene scene(settings_of(0.25, 1));
  const ObjectId low = scene.add(plate_mesh());
  const ObjectId high = scene.add(plate_mesh());
  scene.set_positions(high, lifted(*plate_mesh(), 4));
  scene.step();
  scene.set_positions(high, lifted(*plate_mesh(), 3.5), 0.5);
  scene.step();
  scene.set_positions(high, lifted(*plate_mesh(), 3), 0.5);
  CHECK(scene.step()->pairs().empty());
  scene.set_positions(high, lifted(*plate_mesh(), 0.5), 2.5);
  const ReportHandle report = scene.step();
  CHECK(report->diagnostics().empty());
  REQUIRE(find_pair(*report, low, high) != nullptr);
  CHECK(find_pair(*report, low, high)->distance.upper == 0.5);
}

TEST_CASE("memory that a promise left unread is let go with what was read of it") {
  Row row(BindPolicy::when_told);
  row.lift(5, 0.5F);
  row.scene.positions_changed(row.ids[5], 0.5);
  row.scene.step();
  row.scene.unbind_positions(row.ids[5]);
  row.memory[5].assign(row.memory[5].size(), {nan, nan, nan});
  const ReportHandle report = row.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(report->statistics().objects_unread == 0);
}

TEST_CASE("pairs that have not moved are not tested again") {
  Row row(BindPolicy::when_told);
  row.lift(5, 3.9375F);
  row.scene.positions_changed(row.ids[5]);
  const ReportHandle moved = row.scene.step();
  REQUIRE(only_pair(*moved).phase == PairPhase::began);
  const ReportHandle rested = row.scene.step();
  CHECK(rested->statistics().pairs_tested == 0);
  CHECK(rested->statistics().work.region_pairs_tested == 0);
  CHECK(only_pair(*rested).phase == PairPhase::touching);
  CHECK(timeless_rows_of(*rested, 1) == timeless_rows_of(*row.afresh(), 1));
  row.scene.set_rule(0, 0, {.contact_distance = 0.03125, .range = 1});
  CHECK(only_pair(*row.scene.step()).phase == PairPhase::ended);
  const ReportHandle near = row.scene.step();
  CHECK(only_pair(*near).phase == PairPhase::near);
  CHECK(near->statistics().work.region_pairs_tested == 0);
}

}  // namespace graze::tests
