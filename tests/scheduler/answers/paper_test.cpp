// Accuracy::paper against the paper's method written down naively.

#include <algorithm>
#include <cmath>
#include <iostream>

#include "scheduler/answers/naive_paper.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Moves every vertex a little at random, so that no two distances are equal.
oracle::Shape shaken(oracle::Shape shape, std::uint64_t seed) {
  oracle::Random random(seed);
  for (Eigen::Vector3d& position : shape.positions)
    for (int axis = 0; axis < 3; ++axis) position[axis] += random.between(-1e-3, 1e-3);
  return shape;
}

/// Two bodies of several hundred vertices at rest, and where they are now: turned, bent and close together.
struct Stage {
  explicit Stage(std::uint64_t seed) {
    oracle::Random random(seed);
    const bool small = seed % 3 == 2;  // one leaf against a tree
    rest_a = shaken(shape_of(models::torus(40, 14, 1, 0.3)), seed);
    rest_b = shaken(shape_of(small ? models::sphere(6, 4) : models::sphere(24, 14)), seed + 100);
    now_a = rest_a.positions;
    now_b = rest_b.positions;
    const double turn = random.between(0, 3);
    for (Eigen::Vector3d& p : now_a) p.z() += 0.2 * p.x() * p.y();
    for (Eigen::Vector3d& p : now_b) {
      p = Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 2, 3).normalized()) * p;
      p.x() += random.between(0, 1e-3) + 2.25;
    }
  }

  ReportHandle step(const SceneSettings& settings, std::uint32_t kind_b = 0, const PairRule* rule = nullptr) {
    Scene scene(settings);
    ObjectSettings second;
    second.kind = kind_b;
    const ObjectId a = scene.add(mesh_of(rest_a));
    const ObjectId b = scene.add(mesh_of(rest_b), second);
    scene.set_positions(a, now_a);
    scene.set_positions(b, now_b);
    if (rule != nullptr) scene.set_rule(0, kind_b, *rule);
    return scene.step();
  }

  oracle::Shape rest_a, rest_b;
  Positions now_a, now_b;
};

SceneSettings paper_settings(ContactDetail detail, double contact_distance, std::vector<double> epsilon) {
  SceneSettings settings = settings_of(contact_distance, 100, detail);
  settings.accuracy = Accuracy::paper(std::move(epsilon));
  return settings;
}

/// Empty where a report of one pair has the contacts that the naive method found.
std::string difference_of(const FrameReport& report, const NaivePaper::Found& expected) {
  std::vector<PaperContact> found;
  for (const Contact& contact : report.contacts()) {
    if (contact.kind != ContactKind::VV) return "a contact that is not of vertices";
    found.push_back({contact.feature_a.index, contact.feature_b.index, contact.distance});
  }
  if (found.size() != expected.contacts.size())
    return std::to_string(found.size()) + " contacts instead of " + std::to_string(expected.contacts.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].a != expected.contacts[i].a || found[i].b != expected.contacts[i].b ||
        std::abs(found[i].distance - expected.contacts[i].distance) > 1e-14)
      return "contact " + std::to_string(i) + " is another";
  if (report.statistics().work.leaf_pairs_tested != expected.leaf_pairs)
    return std::to_string(report.statistics().work.leaf_pairs_tested) + " leaf pairs instead of " +
           std::to_string(expected.leaf_pairs);
  return {};
}

void check_bounds(const FrameReport& report, const Stage& stage) {
  const oracle::Pair truth =
      oracle::vertex_distance({stage.now_a, stage.rest_a.faces}, {stage.now_b, stage.rest_b.faces});
  const PairReport& pair = only_pair(report);
  REQUIRE(pair.distance.lower <= truth.distance_down);
  REQUIRE(pair.distance.upper >= truth.distance_up);
  const Witness& witness = pair.witness;
  REQUIRE(witness.point_a == stage.now_a[witness.feature_a.index]);
  REQUIRE(witness.point_b == stage.now_b[witness.feature_b.index]);
  REQUIRE((witness.point_b - witness.point_a).norm() == Approx(pair.distance.upper).epsilon(1e-15));
}

const std::vector<std::vector<double>> epsilons = {{1.5, 0.8, 0.4}, {2.5, 0.9, 0.2},    {1.2, 0.5},
                                                   {0.9},           {3, 1.5, 0.6, 0.3}, {}};

}  // namespace

TEST_CASE("paper accuracy finds what the paper's method finds") {
  std::size_t contacts = 0;
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Stage stage(seed);
    const NaivePaper naive(stage.rest_a, stage.rest_b, stage.now_a, stage.now_b);
    for (const std::vector<double>& epsilon : epsilons)
      for (const ContactDetail detail : {ContactDetail::regions, ContactDetail::vertices}) {
        INFO("seed " << seed << ", " << epsilon.size() << " numbers");
        const double contact_distance = 0.35;
        const ReportHandle report = stage.step(paper_settings(detail, contact_distance, epsilon));
        const auto expected = naive.find(epsilon, epsilon.empty() ? contact_distance : epsilon.back(),
                                         detail == ContactDetail::vertices);
        REQUIRE(difference_of(*report, expected) == "");
        REQUIRE(inconsistency_of(*report) == "");
        check_bounds(*report, stage);
        const PairPhase phase = expected.contacts.empty() ? PairPhase::near : PairPhase::began;
        REQUIRE(only_pair(*report).phase == phase);
        contacts += expected.contacts.size();
        ++compared;
      }
  }
  CHECK(contacts > 500);
  std::cout << "compared " << compared << " pairs, " << contacts << " contacts\n";
}

TEST_CASE("the paper's test misses contacts that are there") {
  Stage stage(0);
  SceneSettings settings = paper_settings(ContactDetail::vertices, 0, {0.25, 0.25, 0.4});
  const std::size_t found = stage.step(settings)->contacts().size();
  settings = settings_of(0.4, 100, ContactDetail::vertices);
  CHECK(found < stage.step(settings)->contacts().size());
}

TEST_CASE("a rule's epsilon takes the place of the scene's") {
  Stage stage(1);
  const NaivePaper naive(stage.rest_a, stage.rest_b, stage.now_a, stage.now_b);
  PairRule rule;
  rule.contact_distance = 0.33;
  rule.range = 100;
  for (const std::vector<double>& epsilon : {std::vector{1.5, 0.8, 0.4}, std::vector{2.5, 0.9, 0.2}}) {
    rule.epsilon = epsilon;
    for (const std::vector<double>& scenes : {std::vector{0.1, 0.05}, std::vector<double>{}}) {
      const ReportHandle report = stage.step(paper_settings(ContactDetail::vertices, 0.01, scenes), 5, &rule);
      REQUIRE(difference_of(*report, naive.find(epsilon, epsilon.back(), true)) == "");
      check_bounds(*report, stage);
    }
  }
  // Without numbers of its own a rule has the scene's, and where there are none its contact distance.
  rule.epsilon.clear();
  const std::vector<double> scenes = {1.2, 0.5};
  CHECK(difference_of(*stage.step(paper_settings(ContactDetail::vertices, 0.01, scenes), 5, &rule),
                      naive.find(scenes, 0.5, true)) == "");
  CHECK(difference_of(*stage.step(paper_settings(ContactDetail::vertices, 0.01, {}), 5, &rule),
                      naive.find({}, 0.33, true)) == "");
}

TEST_CASE("in other accuracies a rule's epsilon means nothing") {
  Stage stage(1);
  PairRule rule{0.33, 100, {5, 5, 5}};
  PairRule plain{0.33, 100, {}};
  const SceneSettings settings = settings_of(0.01, 100, ContactDetail::vertices);
  CHECK(rows_of(*stage.step(settings, 5, &rule)) == rows_of(*stage.step(settings, 5, &plain)));
}

TEST_CASE("margins widen the paper's last number") {
  Stage stage(1);
  const NaivePaper naive(stage.rest_a, stage.rest_b, stage.now_a, stage.now_b);
  Scene scene(paper_settings(ContactDetail::vertices, 0, {1.5, 0.8, 0.25}));
  ObjectSettings with_margin;
  with_margin.margin = 0.0625;
  scene.set_positions(scene.add(mesh_of(stage.rest_a), with_margin), stage.now_a);
  scene.set_positions(scene.add(mesh_of(stage.rest_b), with_margin), stage.now_b);
  CHECK(difference_of(*scene.step(), naive.find({1.5, 0.8, 0.25}, 0.375, true)) == "");
}

}  // namespace graze::tests
