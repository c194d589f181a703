// lower ≤ truth ≤ upper, in every mode and at every level, at random and very often. GRAZE_BOUND_CHECKS in
// the environment says how often.

#include <cstdlib>
#include <iostream>
#include <utility>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"
#include "hard_cases/region_truth.hpp"
#include "hard_cases/scene_comparison.hpp"
#include "pair/bounds.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/exact/exact.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

std::uint64_t check_count() {
  const char* const asked = std::getenv("GRAZE_BOUND_CHECKS");
  return asked == nullptr ? repeats(1'000'000) : std::strtoull(asked, nullptr, 10);
}

/// Counts what was checked and how often it did not hold.
class Checks {
 public:
  template <typename Describe>
  void expect(bool holds, const Describe& describe) {
    ++made_;
    if (holds) return;
    if (++violations_ <= 5) FAIL_CHECK(describe());
  }
  /// A lower and an upper bound against how far a pair really is apart.
  template <typename Describe>
  void bounds(const DistanceBounds& bounds, const oracle::Pair& truth, const Describe& describe) {
    loose_ += bounds.lower < truth.distance_down || bounds.upper > truth.distance_up ? 1U : 0U;
    expect(bounds.lower <= truth.distance_down, [&] { return "lower bound: " + describe(); });
    expect(bounds.upper >= truth.distance_up, [&] { return "upper bound: " + describe(); });
  }
  [[nodiscard]] std::uint64_t made() const { return made_; }
  /// Pairs of bounds that were further apart than rounding.
  [[nodiscard]] std::uint64_t loose() const { return loose_; }

 private:
  std::uint64_t made_ = 0;
  std::uint64_t loose_ = 0;
  std::uint64_t violations_ = 0;
};

/// How far two shapes are apart, as surfaces and as sets of vertices.
struct Truth {
  Truth(const Shape& a, const Shape& b)
      : surfaces(oracle::surface_distance(a, b)), vertices(oracle::vertex_distance(a, b)) {}

  [[nodiscard]] const oracle::Pair& of(ContactDetail detail) const {
    return is_about_vertices(detail) ? vertices : surfaces;
  }

  oracle::Pair surfaces, vertices;
};

double any_tolerance(Random& random) {
  return random.chance(0.1) ? 0 : std::ldexp(1.0, 1 - static_cast<int>(random.below(20)));
}

std::vector<double> any_epsilon(Random& random) {
  std::vector<double> epsilon;
  const std::uint32_t count = random.below(4);
  for (std::uint32_t i = 0; i < count; ++i) epsilon.push_back(random.between(0, 1));
  return epsilon;
}

/// The queries of one detail: exact, within tolerances, as in the paper, and cut short in work and time.
class Queries {
 public:
  Queries(ContactDetail detail, double threshold, Random& random) {
    const PairQuery exact = query_of(detail, threshold);
    add(exact);
    for (int i = 0; i < 6; ++i) {
      add(exact).tolerance = any_tolerance(random);
      queries_.back().mode = AccuracyMode::within;
    }
    if (is_about_vertices(detail))
      for (int i = 0; i < 4; ++i) {
        add(exact).mode = AccuracyMode::paper;
        epsilons_[static_cast<std::size_t>(i)] = any_epsilon(random);
        queries_.back().epsilon = epsilons_[static_cast<std::size_t>(i)];
      }
    const std::size_t whole = queries_.size();
    for (std::size_t i = 0; i < whole; ++i) {
      PairQuery query = queries_[i];
      query.reach = std::max(threshold, random.between(0, 1));
      add(query);
      query.work_limit = random.below(12);
      add(query);
    }
    add(exact).deadline = std::chrono::steady_clock::now();
  }
  [[nodiscard]] const std::vector<PairQuery>& all() const { return queries_; }

 private:
  PairQuery& add(const PairQuery& query) { return queries_.emplace_back(query); }

  std::array<std::vector<double>, 4> epsilons_;
  std::vector<PairQuery> queries_;
};

/// One pair of shapes, every detail and mode.
void check_pair(std::uint64_t seed, Checks& checks) {
  Random random(seed);
  const oracle::RandomScene given = oracle::random_scene(seed);
  const Truth truth(given.a, given.b);
  const Surface a = surface_of(given.a);
  const Surface b = surface_of(given.b);
  PairDetector detector;
  PairAnswer answer;
  PairCounters counters;
  for (const ContactDetail detail : all_details) {
    const Queries queries(detail, given.threshold, random);
    for (const PairQuery& query : queries.all()) {
      const auto describe = [&] {
        return "seed " + std::to_string(seed) + ", detail " + std::to_string(static_cast<int>(detail)) +
               ", mode " + std::to_string(static_cast<int>(query.mode)) + ", tolerance " +
               std::to_string(query.tolerance) + ", work limit " + std::to_string(query.work_limit);
      };
      detector.detect(a, b, query, answer, counters);
      if (answer.listed)
        checks.bounds(answer.distance, truth.of(detail), describe);
      else
        checks.expect(!is_within(truth.of(detail), query.reach), describe);
    }
    PairDetector::outer_bounds(a, b, query_of(detail, given.threshold), answer);
    checks.bounds(answer.distance, truth.of(detail),
                  [&] { return "outer bounds of seed " + std::to_string(seed); });
  }
}

/// Settings of a scene in any mode, with any budget.
SceneSettings any_settings(Random& random, double threshold) {
  const double range = random.between(0, 2);
  SceneSettings settings = settings_of(threshold, range, all_details[random.below(all_details.size())]);
  const std::uint32_t mode = random.below(3);
  if (mode == 1) settings.accuracy = Accuracy::within(any_tolerance(random));
  if (mode == 2 && is_about_vertices(settings.detail))
    settings.accuracy = Accuracy::paper(any_epsilon(random));
  const std::uint32_t budget = random.below(4);
  if (budget == 1) settings.work_budget = random.below(200);
  if (budget == 2) settings.time_budget = std::chrono::microseconds(0);
  if (budget == 3) settings.time_budget = std::chrono::microseconds(random.below(100));
  return settings;
}

std::string text_of(const SceneSettings& settings) {
  std::string text = "detail " + std::to_string(static_cast<int>(settings.detail)) + ", range " +
                     std::to_string(settings.range) + ", threshold " +
                     std::to_string(settings.contact_distance) + ", mode " +
                     std::to_string(static_cast<int>(settings.accuracy.mode())) + ", tolerance " +
                     std::to_string(settings.accuracy.tolerance());
  for (const double epsilon : settings.accuracy.epsilon()) text += ", epsilon " + std::to_string(epsilon);
  if (settings.work_budget) text += ", work " + std::to_string(*settings.work_budget);
  if (settings.time_budget) text += ", microseconds " + std::to_string(settings.time_budget->count());
  return text;
}

/// Pairs nearer than this are listed. As in the paper its last number takes the place of the threshold.
double reach_of(const SceneSettings& settings) {
  const auto& epsilon = settings.accuracy.epsilon();
  return std::max(settings.range, epsilon.empty() ? settings.contact_distance : epsilon.back());
}

/// Four bodies that move a little and much from step to step, in scenes of many settings at once.
void check_scenes(std::uint64_t seed, Checks& checks) {
  Random random(seed);
  std::vector<Body> bodies;
  double threshold = 0;
  for (std::uint64_t i = 0; i < 2; ++i) {
    const oracle::RandomScene given = oracle::random_scene(2 * seed + i);
    bodies.insert(bodies.end(), {given.a, given.b});
    threshold = std::max(threshold, given.threshold);
  }
  std::vector<std::unique_ptr<BodyScene>> scenes;
  for (int i = 0; i < 24; ++i)
    scenes.push_back(std::make_unique<BodyScene>(bodies, any_settings(random, threshold)));
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<ReportHandle> reports;
    for (const auto& scene : scenes) reports.push_back(scene->step(bodies));
    for (std::size_t a = 0; a < bodies.size(); ++a)
      for (std::size_t b = a + 1; b < bodies.size(); ++b) {
        const Truth truth(bodies[a].now, bodies[b].now);
        for (std::size_t i = 0; i < scenes.size(); ++i) {
          const SceneSettings& settings = scenes[i]->scene().settings();
          const auto describe = [&] {
            return "scene of seed " + std::to_string(seed) + ", frame " + std::to_string(frame) + ", " +
                   text_of(settings) + ", objects " + std::to_string(a) + " and " + std::to_string(b);
          };
          const oracle::Pair& apart = truth.of(settings.detail);
          const PairReport* const row = find_pair(*reports[i], scenes[i]->ids()[a], scenes[i]->ids()[b]);
          if (row != nullptr)
            checks.bounds(row->distance, apart, describe);
          else
            checks.expect(!is_within(apart, reach_of(settings)), describe);
        }
      }
    Body& moved = bodies[random.below(4)];
    const double size = random.chance(0.5) ? 0.01 : 1;
    moved.now = mapped(moved.now, 1, Vector3d{random.between(-size, size), random.between(-size, size), 0});
  }
}

/// Two numbers, the first drawn first.
std::array<std::uint32_t, 2> any_below(Random& random, std::uint32_t u, std::uint32_t v) {
  return {random.below(u), random.below(v)};
}

/// A few hundred vertices with two or three levels of regions.
Shape any_large_shape(Random& random) {
  const std::uint32_t form = random.below(4);
  if (form == 0) {
    const auto [u, v] = any_below(random, 28, 16);
    return shape_of(models::sphere(12 + u, 8 + v));
  }
  if (form == 1) {
    const auto [u, v] = any_below(random, 24, 12);
    return shape_of(models::torus(16 + u, 8 + v, 0.8, 0.3));
  }
  if (form == 2) {
    const auto [u, v] = any_below(random, 15, 15);
    return shape_of(models::sheet(10 + u, 10 + v, 2, 2));
  }
  const auto [u, v] = any_below(random, 20, 10);
  return shape_of(models::sphere(12 + u, 8 + v, models::Faces::quads));
}

/// A surface's vertices, without faces.
Shape vertices_of(const Surface& surface) {
  Shape shape;
  for (std::uint32_t vertex = 0; vertex < surface.mesh().vertex_count(); ++vertex)
    shape.positions.push_back(surface.position(vertex));
  return shape;
}

/// The faces that a region owns, as a shape.
Shape faces_of(const Surface& surface, const Region& region) {
  Shape shape = vertices_of(surface);
  for (const std::uint32_t face : surface.mesh().regions().faces(region)) {
    const auto corners = surface.mesh().face(face);
    shape.faces.emplace_back(corners.begin(), corners.end());
  }
  return shape;
}

/// Every pair of regions of two surfaces at every level: spheres, boxes and middle vertices.
void check_regions(const Surface& a, const Surface& b, std::uint64_t seed, Random& random, Checks& checks) {
  const RegionTruth truth(a, b);
  const RegionBounds vertex_bounds(a, b, RefitOf::vertices);
  const RegionBounds face_bounds(a, b, RefitOf::faces);
  const auto regions_a = a.mesh().regions().regions();
  const auto regions_b = b.mesh().regions().regions();
  for (std::uint32_t i = 0; i < regions_a.size(); ++i)
    for (std::uint32_t j = 0; j < regions_b.size(); ++j) {
      const auto describe = [&] {
        return "regions " + std::to_string(i) + " and " + std::to_string(j) + " of seed " +
               std::to_string(seed);
      };
      checks.expect(truth.is_at_least(i, j, vertex_bounds.lower({i, j})), describe);
      checks.expect(truth.is_at_least(i, j, vertex_bounds.lower_with_spheres({i, j})), describe);
      checks.expect(truth.is_at_least(i, j, face_bounds.lower({i, j})), describe);
      const double middles = upper_distance(a.middle(regions_a[i]), b.middle(regions_b[j]));
      checks.expect(truth.is_at_most(i, j, middles), describe);
    }
  for (int sample = 0; sample < 4; ++sample) {
    const std::uint32_t i = random.below(static_cast<std::uint32_t>(regions_a.size()));
    const std::uint32_t j = random.below(static_cast<std::uint32_t>(regions_b.size()));
    if (regions_a[i].face_count == 0 || regions_b[j].face_count == 0) continue;
    if (regions_a[i].face_count * regions_b[j].face_count > 4000) continue;
    const oracle::Pair apart = oracle::surface_distance(faces_of(a, regions_a[i]), faces_of(b, regions_b[j]));
    checks.expect(face_bounds.lower({i, j}) <= apart.distance_down,
                  [&] { return "faces of regions of seed " + std::to_string(seed); });
  }
}

bool holds(const Box& box, const Vector3d& point) {
  return (box.min.array() <= point.array()).all() && (point.array() <= box.max.array()).all();
}

/// Boxes hold every corner of what the regions own, and radii every vertex (exactly).
void check_covers(const Surface& surface, std::uint64_t seed, Checks& checks) {
  const IndexedMesh& mesh = surface.mesh();
  const RegionTree& tree = mesh.regions();
  for (std::uint32_t i = 0; i < tree.regions().size(); ++i) {
    const Region& region = tree.region(i);
    bool covered = true;
    for (const std::uint32_t vertex : tree.vertices(region))
      covered = covered && holds(surface.vertex_boxes()[i], surface.position(vertex)) &&
                holds(surface.face_boxes()[i], surface.position(vertex));
    for (const std::uint32_t face : tree.faces(region))
      for (const std::uint32_t corner : mesh.face(face))
        covered = covered && holds(surface.face_boxes()[i], surface.position(corner));
    for (const std::uint32_t edge : tree.edges(region))
      for (const std::uint32_t end : mesh.edge(edge))
        covered = covered && holds(surface.face_boxes()[i], surface.position(end));
    checks.expect(covered,
                  [&] { return "cover of region " + std::to_string(i) + ", seed " + std::to_string(seed); });
  }
}

/// Two surfaces with regions, refitted where they are, and moved on without a refit.
void check_region_bounds(std::uint64_t seed, Checks& checks) {
  Random random(seed);
  const double far = random.chance(0.2) ? 0x1p30 : 1;
  const auto somewhere = [&] {
    return Vector3d{random.between(-2, 2) * far, random.between(-1, 1), random.between(-1, 1)};
  };
  const Vector3d place = somewhere();
  const Shape rest_a = any_large_shape(random);
  const Shape rest_b = any_large_shape(random);
  Surface a = surface_of({rest_a, mapped(wobbled(rest_a, 0.1, seed), 1, place)});
  const Vector3d beside = random.chance(0.5) ? place + Vector3d(random.between(-2, 2), 0.1, 0) : somewhere();
  Surface b = surface_of({rest_b, mapped(wobbled(turned(rest_b, seed), 0.2, seed + 1), 1, beside)});
  check_covers(a, seed, checks);
  check_covers(b, seed, checks);
  check_regions(a, b, seed, random, checks);
  const double little = std::ldexp(1.0, -static_cast<int>(random.below(12)));
  a.set_positions(wobbled(vertices_of(a), little * 0.1, seed + 2).positions);
  check_regions(a, b, seed, random, checks);
}

}  // namespace

TEST_CASE("bound checks: pairs, in every detail and mode") {
  Checks checks;
  const std::uint64_t count = check_count() / 2;
  for (std::uint64_t seed = 100'000; checks.made() < count; ++seed) check_pair(seed, checks);
  CHECK(checks.loose() > checks.made() / 50);
  std::cout << "compared " << checks.made() << " bounds of pairs, " << checks.loose()
            << " pairs of them loose\n";
}

TEST_CASE("bound checks: scenes that move, in every mode and budget") {
  Checks checks;
  const std::uint64_t count = check_count() / 5;
  for (std::uint64_t seed = 200'000; checks.made() < count; ++seed) check_scenes(seed, checks);
  CHECK(checks.loose() > checks.made() / 50);
  std::cout << "compared " << checks.made() << " bounds of scenes, " << checks.loose()
            << " pairs of them loose\n";
}

TEST_CASE("bound checks: every pair of regions at every level") {
  Checks checks;
  const std::uint64_t count = check_count() * 3 / 10;
  for (std::uint64_t seed = 300'000; checks.made() < count; ++seed) check_region_bounds(seed, checks);
  std::cout << "compared " << checks.made() << " bounds of regions\n";
}

}  // namespace graze::tests
