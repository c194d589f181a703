// This test checks the promises to the user about bounds, budgets and tolerances, on larger and real meshes.

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "core/comparison.hpp"
#include "core/mesh_files.hpp"
#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using oracle::Shape;

/// Pairs of the paper's models side by side, and neighbouring links of a real chain where there is one.
std::vector<std::pair<Shape, Shape>> real_pairs() {
  std::vector<std::pair<Shape, Shape>> pairs;
  const auto& models = paper_models();
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Shape& a = models[i].shape;
    pairs.emplace_back(a, placed_beside(turned(models[(i + 1) % models.size()].shape, i), a, 0, 0.1));
  }
  const std::string chain = std::string(GRAZE_SHARED_DATA) + "/bodies/chain__10-links.obj";
  if (!std::filesystem::exists(chain)) return pairs;
  const auto links = read_obj_objects(chain);
  for (std::size_t i = 0; i + 2 < links.size(); ++i) pairs.emplace_back(links[i], links[i + 2]);
  return pairs;
}

std::uint64_t work_of(const Shape& a, const Shape& b, ContactDetail detail, const Accuracy& accuracy,
                      DistanceBounds& bounds) {
  SceneSettings settings = settings_of(0, infinity, detail);
  settings.accuracy = accuracy;
  BodyScene scene({a, b}, settings);
  const ReportHandle report = scene.step({a, b});
  bounds = only_pair(*report).distance;
  return report->statistics().work.region_pairs_tested;
}

}  // namespace

TEST_CASE("within a tolerance: fewer region pairs than exact on the paper's and on real meshes") {
  const auto pairs = real_pairs();
  for (const ContactDetail detail : all_details) {
    std::uint64_t exact_work = 0;
    std::vector<std::uint64_t> loose_work;
    for (const double tolerance : {0.01, 0.05, 0.25}) {
      exact_work = 0;
      loose_work.push_back(0);
      for (const auto& [a, b] : pairs) {
        DistanceBounds truth;
        DistanceBounds bounds;
        exact_work += work_of(a, b, detail, Accuracy::exact(), truth);
        loose_work.back() += work_of(a, b, detail, Accuracy::within(tolerance), bounds);
        CHECK(bounds.lower <= truth.lower);
        CHECK(bounds.upper >= truth.upper);
        CHECK(bounds.upper - bounds.lower <= tolerance + bounds.upper * 0x1p-40);
      }
      CHECK(loose_work.back() <= exact_work);
    }
    CHECK(std::is_sorted(loose_work.rbegin(), loose_work.rend()));
    CHECK(loose_work.back() < exact_work * 3 / 4);
    std::cout << "compared " << pairs.size() << " pairs of meshes, detail " << static_cast<int>(detail)
              << ": " << exact_work << " region pairs exact, " << loose_work[0] << ", " << loose_work[1]
              << " and " << loose_work[2] << " within 0.01, 0.05 and 0.25\n";
  }
}

TEST_CASE("time budget: a heavy step returns near its deadline, the most urgent pairs first") {
  // Balls inside one another, all in contact with all.
  const Shape ball = shape_of(models::sphere(22, 13));
  std::vector<Body> bodies;
  for (std::uint64_t i = 0; i < 10; ++i)
    bodies.emplace_back(ball, mapped(turned(ball, i), 1, {0.04 * static_cast<double>(i), 0, 0}));
  SceneSettings settings = settings_of(0.05, infinity);
  BodyScene unlimited(bodies, settings);
  const double full_ms = unlimited.step(bodies)->statistics().times.step_ms;
  settings.time_budget = std::chrono::microseconds(static_cast<std::int64_t>(full_ms * 1000 / 8));
  const double budget_ms = full_ms / 8;
  double fastest = infinity;
  for (int attempt = 0; attempt < 5; ++attempt) {
    BodyScene scene(bodies, settings);
    const ReportHandle report = scene.step(bodies);
    CHECK_FALSE(report->complete());
    fastest = std::min(fastest, report->statistics().times.step_ms);
    std::size_t done = 0;
    for (const PairReport& row : report->pairs()) done += row.complete ? 1U : 0U;
    CHECK(done < report->pairs().size());
    // The next step must first do the pairs that were in contact in the last step.
    const ReportHandle next = scene.step(bodies);
    bool contact_undone = false;
    bool other_done = false;
    for (const PairReport& row : next->pairs()) {
      const PairReport* const last = find_pair(*report, row.a, row.b);
      REQUIRE(last != nullptr);
      const bool was = last->phase == PairPhase::began || last->phase == PairPhase::touching;
      contact_undone = contact_undone || (was && !row.complete);
      other_done = other_done || (!was && row.complete);
    }
    CHECK_FALSE((contact_undone && other_done));
  }
  // One pair of leaves, positions and the report may come on top.
  CHECK(fastest <= budget_ms * 2 + 20);
  std::cout << "compared a budget of " << budget_ms << " ms with a step of " << fastest
            << " ms, without budget " << full_ms << " ms\n";
}

}  // namespace graze::tests
