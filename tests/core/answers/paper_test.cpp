// AccuracyMode::paper against a plain implementation of the contract's rule, and how far its answers are from
// exact ones (printed: what it misses and what it finds beyond).

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <set>

#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::OracleRegion;
using oracle::Shape;

using VertexPair = std::pair<std::uint32_t, std::uint32_t>;
using VertexPairs = std::set<VertexPair>;

/// Steps of the grid that positions lie on: squared distances are then exact in double.
constexpr double grid = 0x1p-18;

/// A body with the oracle's tree and adjacency.
struct Indexed {
  explicit Indexed(const Body& body)
      : positions(body.now.positions),
        regions(oracle::regions_of(body.rest)),
        children(regions.size()),
        radii(oracle::level_radii(regions, positions)),
        neighbours(positions.size()) {
    for (std::size_t child = 1; child < regions.size(); ++child) children[parent_of(child)].push_back(child);
    for (const auto& [low, high] : oracle::edges_of(body.rest)) {
      neighbours[low].insert(high);
      neighbours[high].insert(low);
    }
    for (std::uint32_t vertex = 0; vertex < neighbours.size(); ++vertex) neighbours[vertex].insert(vertex);
  }

  [[nodiscard]] std::size_t parent_of(std::size_t child) const {
    for (std::size_t parent = 0;; ++parent)
      if (regions[parent].level + 1 == regions[child].level &&
          std::binary_search(regions[parent].vertices.begin(), regions[parent].vertices.end(),
                             regions[child].vertices[0]))
        return parent;
  }

  std::vector<Vector3d> positions;
  std::vector<OracleRegion> regions;
  std::vector<std::vector<std::size_t>> children;
  std::vector<double> radii;
  std::vector<std::set<std::uint32_t>> neighbours;  ///< each vertex itself included
};

/// The paper's method by recursion over pairs of regions. The order does not matter to the set it reaches.
class NaivePaper {
 public:
  NaivePaper(const Indexed& a, const Indexed& b, std::vector<double> epsilon, double threshold)
      : a_(a), b_(b), epsilon_(std::move(epsilon)), threshold_(threshold) {
    visit(0, 0, true);
  }

  VertexPairs walked;    ///< DV's answers
  VertexPairs vertices;  ///< all close pairs of the leaves reached
  std::size_t leaf_pairs = 0;

 private:
  [[nodiscard]] double squared(std::uint32_t a, std::uint32_t b) const {
    return (b_.positions[b] - a_.positions[a]).squaredNorm();
  }

  void visit(std::size_t a, std::size_t b, bool is_root) {
    const OracleRegion& region_a = a_.regions[a];
    const OracleRegion& region_b = b_.regions[b];
    if (region_a.leaf && region_b.leaf) return visit_leaves(region_a, region_b);
    const double epsilon = epsilon_of(region_a.level, region_b.level);
    if (!is_root && !(squared(region_a.middle, region_b.middle) < epsilon * epsilon)) return;
    const std::vector<std::size_t> next_a = region_a.leaf ? std::vector{a} : a_.children[a];
    const std::vector<std::size_t> next_b = region_b.leaf ? std::vector{b} : b_.children[b];
    for (const std::size_t i : next_a)
      for (const std::size_t j : next_b) visit(i, j, false);
  }

  [[nodiscard]] double epsilon_of(std::uint32_t level_a, std::uint32_t level_b) const {
    if (epsilon_.empty()) return a_.radii[level_a] + b_.radii[level_b];
    const std::size_t level = std::max<std::size_t>({level_a, level_b, 1});
    return level < epsilon_.size() ? epsilon_[level - 1] : epsilon_[epsilon_.size() - 2];
  }

  void visit_leaves(const OracleRegion& leaf_a, const OracleRegion& leaf_b) {
    ++leaf_pairs;
    for (const std::uint32_t i : leaf_a.vertices)
      for (const std::uint32_t j : leaf_b.vertices)
        if (squared(i, j) < threshold_ * threshold_) vertices.insert({i, j});
    VertexPair at = nearest(leaf_a.vertices, leaf_b.vertices);
    while (true) {
      const VertexPair next = nearest(a_.neighbours[at.first], b_.neighbours[at.second]);
      if (squared(next.first, next.second) >= squared(at.first, at.second)) break;
      at = next;
    }
    if (squared(at.first, at.second) < threshold_ * threshold_) walked.insert(at);
  }

  /// Ties to the lowest a, then b: both are ascending.
  [[nodiscard]] VertexPair nearest(const auto& of_a, const auto& of_b) const {
    VertexPair best{*of_a.begin(), *of_b.begin()};
    for (const std::uint32_t i : of_a)
      for (const std::uint32_t j : of_b)
        if (squared(i, j) < squared(best.first, best.second)) best = {i, j};
    return best;
  }

  const Indexed& a_;
  const Indexed& b_;
  std::vector<double> epsilon_;
  double threshold_;
};

VertexPairs pairs_of(const PairAnswer& answer) {
  VertexPairs pairs;
  for (const Contact& contact : answer.contacts)
    pairs.insert({contact.feature_a.index, contact.feature_b.index});
  CHECK(pairs.size() == answer.contacts.size());
  return pairs;
}

std::size_t count_missing(const VertexPairs& from, const VertexPairs& in) {
  return static_cast<std::size_t>(
      std::count_if(from.begin(), from.end(), [&](const VertexPair& pair) { return !in.contains(pair); }));
}

PairQuery paper_query(ContactDetail detail, double threshold, const std::vector<double>& epsilon) {
  PairQuery query = query_of(detail, threshold);
  query.mode = AccuracyMode::paper;
  query.epsilon = epsilon;
  return query;
}

struct Placed {
  std::string name;
  Body a, b;
};

/// Pairs of the paper's models side by side, on the grid, at rest and deformed.
std::vector<Placed> pairs_at(double gap) {
  const auto& models = paper_models();
  std::vector<Placed> pairs;
  for (const auto& [i, j] : std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {1, 2}, {3, 4}}) {
    const Shape a = snapped(models[i].shape, grid);
    const Shape b = snapped(placed_beside(models[j].shape, a, 0, gap), grid);
    const std::string name = models[i].name + " and " + models[j].name;
    pairs.push_back({name, a, b});
    pairs.push_back({name + ", deformed",
                     {a, snapped(wobbled(a, 0.1, 1), grid)},
                     {b, snapped(wobbled(b, 0.1, 2), grid)}});
  }
  return pairs;
}

void check_bounds(const PairAnswer& answer, const oracle::Pair& truth) {
  CHECK(answer.distance.lower <= truth.distance_down);
  CHECK(answer.distance.upper >= truth.distance_up);
  CHECK((answer.witness.point_b - answer.witness.point_a).norm() == Approx(answer.distance.upper));
}

/// No neighbour of either end, nor both together, is nearer.
void check_locally_minimal(const PairAnswer& answer, const Indexed& a, const Indexed& b) {
  for (const auto& [i, j] : pairs_of(answer)) {
    const double here = (b.positions[j] - a.positions[i]).squaredNorm();
    for (const std::uint32_t p : a.neighbours[i])
      for (const std::uint32_t q : b.neighbours[j])
        CHECK((b.positions[q] - a.positions[p]).squaredNorm() >= here);
  }
}

}  // namespace

TEST_CASE("paper: its answers are those of a plain implementation of its rule") {
  std::size_t compared = 0;
  std::size_t leaf_pairs = 0;
  const std::vector<std::vector<double>> numbers{
      {}, {0.9, 0.4, 0.1}, {0.7, 0.5, 0.3, 0.1}, {0.2, 0.1}, {0.0, 0.1}};
  for (const double gap : {-0.2, 0.02}) {
    for (const Placed& pair : pairs_at(gap)) {
      const Surface a = surface_of(pair.a);
      const Surface b = surface_of(pair.b);
      const Indexed indexed_a(pair.a);
      const Indexed indexed_b(pair.b);
      const oracle::Pair truth = oracle::vertex_distance(pair.a.now, pair.b.now);
      const VertexPairs exact = pairs_of(detect(a, b, query_of(ContactDetail::vertices, 0.1)));
      for (const auto& epsilon : numbers) {
        INFO(pair.name << ", gap " << gap << ", " << epsilon.size() << " numbers");
        const NaivePaper naive(indexed_a, indexed_b, epsilon, 0.1);
        const PairAnswer walked = detect(a, b, paper_query(ContactDetail::regions, 0.1, epsilon));
        const PairAnswer vertices = detect(a, b, paper_query(ContactDetail::vertices, 0.1, epsilon));
        CHECK(pairs_of(walked) == naive.walked);
        CHECK(pairs_of(vertices) == naive.vertices);
        CHECK(count_missing(naive.vertices, exact) == 0);
        CHECK(count_missing(naive.walked, exact) == 0);
        CHECK(walked.in_contact == !naive.walked.empty());
        check_bounds(walked, truth);
        check_bounds(vertices, truth);
        check_locally_minimal(walked, indexed_a, indexed_b);
        compared += naive.walked.size() + naive.vertices.size();
        leaf_pairs += naive.leaf_pairs;
      }
    }
  }
  CHECK(compared > 1000);
  CHECK(leaf_pairs > 1000);
  std::cout << "compared " << compared << " contacts and " << leaf_pairs
            << " leaf pairs of the paper's mode\n";
}

TEST_CASE("paper: one number is the threshold of DV and of every level") {
  for (const Placed& pair : pairs_at(-0.1)) {
    const Surface a = surface_of(pair.a);
    const Surface b = surface_of(pair.b);
    INFO(pair.name);
    const NaivePaper naive(Indexed(pair.a), Indexed(pair.b), {0.3, 0.3}, 0.3);
    CHECK(pairs_of(detect(a, b, paper_query(ContactDetail::regions, 0.3, {0.3}))) == naive.walked);
  }
}

TEST_CASE("paper: what it misses and finds beyond exact answers") {
  std::size_t exact_found = 0;
  for (const double gap : {-0.2, -0.05, 0.05}) {
    std::size_t exact_vertices = 0;
    std::size_t missed_vertices = 0;
    std::size_t exact_regions = 0;
    std::size_t missed_regions = 0;
    std::size_t beyond_regions = 0;
    std::size_t missed_contacts = 0;
    for (const Placed& pair : pairs_at(gap)) {
      INFO(pair.name << ", gap " << gap);
      const Surface a = surface_of(pair.a);
      const Surface b = surface_of(pair.b);
      const PairAnswer vertices = detect(a, b, paper_query(ContactDetail::vertices, 0.1, {}));
      const PairAnswer regions = detect(a, b, paper_query(ContactDetail::regions, 0.1, {}));
      const PairAnswer all = detect(a, b, query_of(ContactDetail::vertices, 0.1));
      const VertexPairs nearest = pairs_of(detect(a, b, query_of(ContactDetail::regions, 0.1)));
      CHECK(count_missing(pairs_of(vertices), pairs_of(all)) == 0);
      CHECK(vertices.distance.lower <= all.distance.lower);
      CHECK(vertices.distance.upper >= all.distance.upper);
      CHECK(regions.distance.lower <= all.distance.lower);
      CHECK(regions.distance.upper >= all.distance.upper);
      if (regions.in_contact) CHECK(all.in_contact);
      exact_vertices += all.contacts.size();
      missed_vertices += count_missing(pairs_of(all), pairs_of(vertices));
      exact_regions += nearest.size();
      missed_regions += count_missing(nearest, pairs_of(regions));
      beyond_regions += count_missing(pairs_of(regions), nearest);
      missed_contacts += all.in_contact && !regions.in_contact ? 1 : 0;
    }
    exact_found += exact_vertices;
    std::cout << "paper, gap " << gap << ": misses " << missed_vertices << " of " << exact_vertices
              << " vertex pairs, and of " << exact_regions << " leaf pairs' closest " << missed_regions
              << "; its walks end at " << beyond_regions << " other pairs; contact unnoticed "
              << missed_contacts << " times\n";
  }
  CHECK(exact_found > 100);
}

}  // namespace graze::tests
