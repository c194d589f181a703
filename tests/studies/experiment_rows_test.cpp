// The paper's experiments: their rows, their motions, the plain walk that the library is compared with, and
// what is counted.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/mesh/indexed_mesh.hpp"
#include "experiment/paper/contact_checks.hpp"
#include "experiment/paper/feature_checks.hpp"
#include "experiment/paper/motion/human_parts.hpp"
#include "experiment/paper/motion/motion_files.hpp"
#include "experiment/paper/motion/paper_motions.hpp"
#include "experiment/paper/paper_experiment.hpp"
#include "experiment/paper/paper_measures.hpp"
#include "experiment/paper/paper_rows.hpp"
#include "experiment/paper/paper_walk.hpp"
#include "experiment/paper/region_escapes.hpp"
#include "scheduler/answers/naive_paper.hpp"
#include "support/catch.hpp"
#include "support/model_shape.hpp"
#include "tools/program.hpp"
#include "tools/program_report.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tools {
namespace {

using tests::NaivePaper;
using tests::TemporaryFolder;

ExperimentOptions options_of(std::uint32_t frames, std::uint64_t seed = 1) {
  ExperimentOptions options;
  options.frames = frames;
  options.runs = 1;
  options.seed = seed;
  return options;
}

/// The third experiment, which takes the least time to make.
const RecordedMotion& tooth_motion() {
  static const RecordedMotion motion = record_experiment(3, options_of(6));
  return motion;
}

using VertexName = std::pair<std::uint32_t, std::uint32_t>;

RecordedObject small_object(const models::MeshData& rest, std::vector<std::vector<float>> frames) {
  return {"thing",
          "thing",
          0,
          0,
          rest,
          std::make_shared<const Mesh>(Mesh::from_polygons(rest.positions, rest.corners, rest.corner_counts)),
          std::move(frames)};
}

std::vector<float> frame_of(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> frame;
  for (const Eigen::Vector3d& point : points)
    for (int axis = 0; axis < 3; ++axis) frame.push_back(static_cast<float>(point[axis]));
  return frame;
}

}  // namespace

TEST_CASE("the rows are those of the paper's tables 2, 3 and 4") {
  const auto numbers = [](int experiment) {
    std::vector<std::string> texts;
    for (const PaperRow& row : paper_rows(experiment)) texts.push_back(row.numbers());
    return texts;
  };
  CHECK(numbers(1) ==
        std::vector<std::string>{"20 / 14 / 8", "22 / 14 / 8", "24 / 14 / 8", "30 / 14 / 8", "30 / 20 / 10"});
  CHECK(numbers(2) == std::vector<std::string>{"20, 25 / 15, 20 / 10, 10", "45, 35 / 30, 30 / 10, 10",
                                               "25, 35 / 15, 30 / 10, 10", "40, 40 / 25, 30 / 10, 10",
                                               "25, 45 / 15, 30 / 10, 10"});
  CHECK(numbers(3) == std::vector<std::string>{"20 / 15 / 10", "25 / 12 / 8", "25 / 13 / 10", "25 / 15 / 8",
                                               "30 / 15 / 10"});
  const PaperRow row = paper_rows(2)[best_row];
  CHECK(row.epsilon(0, 0) == std::vector<double>{25, 15, 10});
  CHECK(row.epsilon(1, 0) == std::vector<double>{35, 30, 10});
  CHECK_THROWS(row.epsilon(1, 1));
}

TEST_CASE("a recorded motion is the same again, on its grid, and ends close without touching") {
  const RecordedMotion& motion = tooth_motion();
  const RecordedMotion again = record_experiment(3, options_of(6));
  const RecordedMotion other = record_experiment(3, options_of(6, 2));
  REQUIRE(motion.objects.size() == 2);
  CHECK(motion.objects[0].mesh->vertex_count() == 1202);
  CHECK(motion.objects[1].mesh->vertex_count() == 258);
  CHECK(motion.frame_count() == 6);
  for (std::size_t i = 0; i < 2; ++i) CHECK(motion.objects[i].frames == again.objects[i].frames);
  CHECK(motion.objects[1].frames != other.objects[1].frames);
  CHECK(motion.objects[0].frames.front() == motion.objects[0].frames.back());  // the tooth is rigid
  for (const RecordedObject& object : motion.objects)
    for (const std::vector<float>& frame : object.frames)
      for (const float value : frame) {
        REQUIRE(value * 0x1p14F == std::round(value * 0x1p14F));
        REQUIRE(std::abs(value) < 512);
      }
  PlayedMotion scene(motion, exact_setting(ContactDetail::none, 0, std::numeric_limits<double>::infinity()));
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ReportHandle report = scene.step(frame);
    const double distance = report->pairs()[0].distance.lower;
    CHECK(distance >= 0.25);
    CHECK(distance < before + 1);
    before = distance;
  }
  CHECK(before < 8);
}

TEST_CASE("the plain walk is the paper's method on regions of the oracle") {
  const RecordedMotion& motion = tooth_motion();
  const oracle::Shape tooth = tests::shape_of(motion.objects[0].rest);
  const oracle::Shape cylinder = tests::shape_of(motion.objects[1].rest);
  std::size_t contacts = 0;
  for (std::size_t frame = 3; frame < motion.frame_count(); ++frame) {
    const PlacedObject a(motion.objects[0], frame);
    const PlacedObject b(motion.objects[1], frame);
    const NaivePaper naive(tooth, cylinder, a.points(), b.points());
    PaperWalk walk(a, b);
    for (const PaperRow& row : paper_rows(3)) {
      const std::vector<double>& epsilon = row.epsilon(0, 1);
      const auto expected = naive.find(epsilon, row.last(), false);
      const PaperFound found = walk.find({{epsilon[0], epsilon[1]}, row.last(), false});
      std::set<VertexName> ends;
      for (const std::uint32_t number : found.reached)
        if (const VertexPair& end = walk.leaves(number).walked; end.squared < row.last() * row.last())
          ends.emplace(end.a, end.b);
      std::set<VertexName> expected_ends;
      for (const tests::PaperContact& contact : expected.contacts)
        expected_ends.emplace(contact.a, contact.b);
      CHECK(ends == expected_ends);
      CHECK(found.reached.size() == expected.leaf_pairs);
      contacts += ends.size();
    }
  }
  CHECK(contacts > 10);
}

TEST_CASE("near leaves and vertices are those of brute force over all vertices") {
  const RecordedMotion& motion = tooth_motion();
  const std::size_t frame = motion.frame_count() - 1;
  const PlacedObject a(motion.objects[0], frame);
  const PlacedObject b(motion.objects[1], frame);
  PaperWalk walk(a, b);
  const double distance = 10;
  std::set<VertexName> near;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < a.points().size(); ++i)
    for (std::uint32_t j = 0; j < b.points().size(); ++j) {
      const double squared = (a.points()[i] - b.points()[j]).squaredNorm();
      nearest = std::min(nearest, squared);
      if (squared < distance * distance) near.emplace(i, j);
    }
  std::set<VertexName> found;
  for (const VertexPair& pair : walk.near_vertices(distance)) found.emplace(pair.a, pair.b);
  CHECK(found == near);
  CHECK(near.size() > 100);
  CHECK(walk.nearest_vertices().squared == nearest);

  // A pair of the oracle's leaves is near where one of their vertex pairs is.
  const auto leaves_of = [](const RecordedObject& object) {
    std::vector<std::size_t> leaf_of(object.rest.positions.size());
    const auto regions = oracle::regions_of(tests::shape_of(object.rest));
    for (std::size_t region = 0; region < regions.size(); ++region)
      for (const std::uint32_t vertex : regions[region].vertices)
        if (regions[region].leaf) leaf_of[vertex] = region;
    return leaf_of;
  };
  const auto leaf_a = leaves_of(motion.objects[0]);
  const auto leaf_b = leaves_of(motion.objects[1]);
  std::set<std::pair<std::size_t, std::size_t>> leaves;
  for (const auto& [i, j] : near) leaves.emplace(leaf_a[i], leaf_b[j]);
  CHECK(walk.near_leaves(distance).size() == leaves.size());
  CHECK(walk.near_leaves(0).empty());
}

TEST_CASE("vertices that leave their region's first epsilon are counted") {
  // 40 vertices are more than a leaf holds: regions of level 1 are the leaves.
  const models::MeshData rest = models::sheet(9, 3, 9, 3);
  std::vector<Eigen::Vector3d> moved = rest.positions;
  const RecordedObject still = small_object(rest, {frame_of(rest.positions), frame_of(rest.positions)});
  const auto none = count_escapes({"still", 1, {still}});
  REQUIRE(none.size() == 1);
  CHECK(none[0].vertices == rest.positions.size());
  CHECK(none[0].outside_own == 0);
  CHECK(none[0].furthest == 1);
  const Region& region = indexed(*still.mesh).regions().region(1);
  std::uint32_t far = indexed(*still.mesh).regions().vertices(region)[0];
  if (far == region.middle) far = indexed(*still.mesh).regions().vertices(region)[1];
  moved[far] += Eigen::Vector3d(0, 0, 1000);
  const auto one =
      count_escapes({"moved", 1, {small_object(rest, {frame_of(rest.positions), frame_of(moved)})}});
  CHECK(one[0].outside_own == 1);
  CHECK(one[0].outside_level == 1);
  CHECK(one[0].furthest > 100);
}

TEST_CASE("a contact too few or too many is seen") {
  using Names = std::vector<std::array<std::uint32_t, 2>>;
  const Names truth = {{0, 1}, {2, 3}};
  ContactCheck check;
  tally_contacts(truth, truth, check);
  CHECK(check.wrong == 0);
  tally_contacts(truth, Names{{0, 1}}, check);
  CHECK(check.wrong == 1);
  tally_contacts(truth, Names{{0, 1}, {2, 3}, {4, 4}}, check);
  CHECK(check.wrong == 2);
  CHECK(check.compared == 3);
  CHECK(check.contacts_true == 6);
  CHECK(check.contacts_found == 5);
  CHECK(check.contacts_reported == 6);
}

TEST_CASE("what is measured adds up, and exact mode and within are the truth") {
  const RecordedMotion& motion = tooth_motion();
  ExperimentOptions options = options_of(6);
  options.times = false;
  const PaperResults results = measure_paper(motion, paper_rows(3), options, Extent::all_readings);
  CHECK(results.violations.empty());
  CHECK(results.times.empty());
  REQUIRE(results.rows.size() == 5);
  REQUIRE(results.readings.size() == 10);
  for (std::size_t i = 0; i < 5; ++i) {
    const RowResult& row = results.rows[i];
    REQUIRE(row.steps.size() == motion.frame_count());
    for (const StepCount& step : row.steps) {
      CHECK(step.reported == step.found() + step.extra);
      CHECK(step.contacts <= step.reported);
      CHECK(step.reported <= step.given_to_dv);
    }
    const RowResult& tested = results.readings[i];
    const RowResult& summed = results.readings[5 + i];
    CHECK(tested.found() <= row.found());
    CHECK(row.found() <= summed.found());
    CHECK(tested.sum(&StepCount::truth) == row.sum(&StepCount::truth));
  }
  CHECK(results.rows[0].steps.back().truth > 20);
  std::set<ContactDetail> details;
  for (const ContactCheck& check : results.checks) {
    details.insert(check.detail);
    CHECK(check.wrong == 0);
    CHECK(check.distances_wrong == 0);
    CHECK(check.contacts_true > 0);
  }
  CHECK(details.size() == 3);
}

TEST_CASE("humans in parts have the same faces, each in one part") {
  RecordedMotion motion{"two", 1, {}};
  const models::MeshData human = models::human();
  motion.objects.push_back(small_object(human, {}));
  motion.objects[0].kind = motion.objects[0].name = "human";
  for (int i = 0; i < 5; ++i) motion.objects[0].frames.push_back(frame_of(human.positions));
  const RecordedMotion parts = with_humans_in_parts(motion, 2);
  REQUIRE(parts.objects.size() == 6);
  CHECK(parts.frame_count() == 3);
  std::size_t faces = 0;
  for (const RecordedObject& part : parts.objects) {
    faces += part.mesh->face_count();
    CHECK(part.mesh->face_count() > 100);
    CHECK(part.group == 1);
    CHECK(part.frames[0] == frame_of(part.rest.positions));
  }
  CHECK(faces == 1888);
  CHECK(parts.in_one_group(0, 5));
}

TEST_CASE("the program plays a row's scene file with the same collisions") {
  const TemporaryFolder folder;
  const RecordedMotion& motion = tooth_motion();
  const std::vector<PaperRow> rows = paper_rows(3);
  write_motion(folder.path(), motion, rows);
  std::vector<PlayedSetting> settings;
  for (const PaperRow& row : rows) settings.push_back(setting_of(row));
  settings.push_back(
      exact_setting(ContactDetail::regions, rows[best_row].last(), std::numeric_limits<double>::infinity()));
  const std::vector<std::string> files = {"row_1", "row_2", "row_3", "row_4", "row_5", "exact"};
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    INFO(files[i]);
    const auto report = folder / (files[i] + ".jsonl");
    const tests::ProgramResult run = tests::run_graze(
        {"run", (folder / (files[i] + ".json")).string(), "--threads", "1", "--report", report.string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto frames = tests::read_report(report);
    REQUIRE(frames.size() == motion.frame_count());
    PlayedMotion scene(motion, settings[i]);
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      const ReportHandle expected = scene.step(frame);
      REQUIRE(frames[frame].pairs.size() == 1);
      const auto& found = frames[frame].pairs[0].contacts;
      REQUIRE(found.size() == expected->contacts().size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK(found[k].contact.feature_a == expected->contacts()[k].feature_a);
        CHECK(found[k].contact.feature_b == expected->contacts()[k].feature_b);
        CHECK(found[k].contact.distance == expected->contacts()[k].distance);
      }
      CHECK(frames[frame].statistics.work.regions_expanded == expected->statistics().work.regions_expanded);
      contacts += found.size();
    }
  }
  CHECK(contacts > 50);
}

TEST_CASE("an experiment is a study whose tables are whole") {
  const TemporaryFolder folder;
  ExperimentOptions options = options_of(4);
  options.out = folder.path();
  const Study study = paper_experiment(3, options);
  CHECK(study.violations.empty());
  CHECK(study.name == "experiment_3");
  CHECK(std::filesystem::exists(folder / "experiment_3" / "row_3.json"));
  std::set<std::string> names;
  for (const ResultTable& table : study.tables) {
    CHECK(names.insert(table.name).second);
    CHECK(!table.rows.empty());
    for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
  }
  CHECK(names == std::set<std::string>{"shapes", "rows", "last_step", "readings", "contacts", "escapes",
                                       "times", "steps"});
  for (const Figure& figure : study.figures)
    for (const Series& series : figure.series) CHECK(series.x.size() == 4);
  CHECK(study.claims.size() == 5);
  for (const Claim& claim : study.claims) CHECK(!claim.holds.empty());
}

}  // namespace graze::tools
