// Pairs of vertices of surfaces that meet in one place, of those that lie along each other, and of surfaces
// small and large, beside going through all pairs.

#include "vertex_sweep.hpp"

#include <algorithm>
#include <graze/instruction_set.hpp>
#include <graze/pair_query.hpp>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contact_name.hpp"
#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "kernels/filter.hpp"
#include "support/catch.hpp"
#include "support/model_shape.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

using VertexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// All pairs nearer than the limit; distances are far enough from it that rounding does not matter.
VertexPairs close_pairs(const Surface& a, const Surface& b, double limit) {
  VertexPairs pairs;
  for (std::uint32_t i = 0; i < a.mesh().vertex_count(); ++i)
    for (std::uint32_t j = 0; j < b.mesh().vertex_count(); ++j)
      if (a.mesh().is_used(i) && b.mesh().is_used(j) && (a.position(i) - b.position(j)).norm() < limit)
        pairs.emplace_back(i, j);
  return pairs;
}

VertexPairs pairs_of(const std::vector<Contact>& contacts) {
  VertexPairs pairs;
  for (const Contact& contact : contacts)
    pairs.emplace_back(contact.feature_a.index, contact.feature_b.index);
  return pairs;
}

struct SweepRun {
  Swept swept;
  VertexPairs pairs;
  PairCounters counters;
};

SweepRun sweep(const Surface& a, const Surface& b, double limit,
               std::uint64_t work_limit = std::numeric_limits<std::uint64_t>::max()) {
  PairQuery query = query_of(ContactDetail::vertices, limit);
  query.work_limit = work_limit;
  SweepRun run;
  VertexSweepScratch scratch;
  std::vector<ContactName> names(3);  // of another query
  DecisionCount count;
  WorkMeter meter(query, run.counters);
  run.swept = sweep_close_vertices({a, b, count}, limit, scratch, meter, names);
  for (const ContactName& name : names)
    run.pairs.emplace_back(name.a().feature.index, name.b().feature.index);
  std::sort(run.pairs.begin(), run.pairs.end());
  return run;
}

/// The sweep by itself, and the whole query, which walks where the sweep gives up.
std::size_t check(const Surface& a, const Surface& b, double limit, Swept expected) {
  const VertexPairs pairs = close_pairs(a, b, limit);
  const SweepRun run = sweep(a, b, limit);
  CHECK(run.swept == expected);
  CHECK(run.pairs == (expected == Swept::all ? pairs : VertexPairs{}));
  CHECK(pairs_of(detect(a, b, query_of(ContactDetail::vertices, limit)).contacts) == pairs);
  return pairs.size();
}

/// A grid of the size in the plane, in waves.
oracle::Shape cloth(std::uint32_t rows, double size, std::uint64_t seed) {
  return wobbled(shape_of(models::sheet(rows, rows, size, size)), 0.01 * size, seed);
}

/// Points in rows, each row's own stretch of them, and a reach.
class RowsAndPoints {
 public:
  explicit RowsAndPoints(std::uint64_t seed) : random_(seed) {
    fill(rows_, row_count_);
    fill(points_, point_count_);
    for (std::size_t row = 0; row < row_count_; ++row) {
      first_.push_back(random_.below(point_count_ + 1));
      last_.push_back(first_.back() + random_.below(point_count_ + 1 - first_.back()));
    }
    reach_squared_ = static_cast<float>(random_.between(0, 1));
    begin_ = random_.below(row_count_);
  }

  /// One by one, in the arithmetic that the kernel promises.
  [[nodiscard]] VertexPairs near() const {
    VertexPairs pairs;
    for (std::uint32_t row = begin_; row < row_count_; ++row)
      for (std::uint32_t point = first_[row]; point < last_[row]; ++point) {
        float squared[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float gap = points_[axis * stride + point] - rows_[axis * stride + row];
          squared[axis] = gap * gap;
        }
        if ((squared[0] + squared[1]) + squared[2] < reach_squared_) pairs.emplace_back(row, point);
      }
    return pairs;
  }
  [[nodiscard]] VertexPairs found() const {
    std::vector<std::uint32_t> row(row_count_ * point_count_);
    std::vector<std::uint32_t> point(row.size());
    const std::size_t count = kernels::filter().near_rows(
        {rows_.data(), stride, row_count_}, begin_, row_count_, {points_.data(), stride, point_count_},
        first_.data(), last_.data(), reach_squared_, {row.data(), point.data()});
    VertexPairs pairs;
    for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(row[i], point[i]);
    return pairs;
  }

 private:
  static constexpr std::size_t stride = 40 + kernels::lanes;

  void fill(std::vector<float>& numbers, std::uint32_t& count) {
    count = 1 + random_.below(40);
    for (std::size_t i = 0; i < 3 * stride; ++i)
      numbers.push_back(static_cast<float>(random_.between(-0.5, 0.5)));
  }

  oracle::Random random_;
  std::uint32_t row_count_ = 0;
  std::uint32_t point_count_ = 0;
  std::uint32_t begin_ = 0;
  std::vector<float> rows_;
  std::vector<float> points_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> last_;
  float reach_squared_ = 0;
};

}  // namespace

TEST_CASE("vertex sweep: the kernel finds what is near, the same with every instruction set") {
  const InstructionSet before = instruction_set();
  std::size_t near = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RowsAndPoints given(seed);
    const auto expected = given.near();
    near += expected.size();
    for (const InstructionSet set : available_instruction_sets()) {
      use_instruction_set(set);
      INFO(to_string(set));
      CHECK(given.found() == expected);
    }
  }
  use_instruction_set(before);
  CHECK(near > 5000);
  std::cout << "compared " << near << " near pairs\n";
}

TEST_CASE("vertex sweep: small surfaces of all kinds") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    oracle::Random random(seed);
    // Some of a soup's vertices are unused.
    const Surface a = surface_of(random_soup(seed, 40 + random.below(100), 80));
    Surface b = surface_of(mapped(random_soup(seed + 1, 40 + random.below(100), 80), 1,
                                  {random.between(-1.2, 1.2), random.between(-0.2, 0.2), 0}));
    if (seed % 2 == 0) {
      std::vector<Eigen::Vector3f> floats;
      for (std::uint32_t vertex = 0; vertex < b.mesh().vertex_count(); ++vertex)
        floats.push_back(b.position(vertex).cast<float>());
      b.set_positions(floats);
    }
    const double limits[] = {0, 0.07, 0.31, 5, std::numeric_limits<double>::infinity()};
    compared += check(a, b, limits[seed % 5] * (1 + 0x1p-20), Swept::all);
  }
  CHECK(compared > 10000);
  std::cout << "compared " << compared << " pairs of vertices\n";
}

TEST_CASE("vertex sweep: large surfaces that meet in a corner") {
  const Surface a = surface_of(cloth(100, 1, 1));
  Surface b = surface_of(mapped(cloth(95, 1, 2), 1, {0.8, 0.85, 0.005}));
  CHECK(check(a, b, 0.03, Swept::all) > 100);
  // Boxes are those of an earlier place.
  std::vector<Eigen::Vector3d> moved;
  for (std::uint32_t vertex = 0; vertex < b.mesh().vertex_count(); ++vertex)
    moved.push_back(b.position(vertex) + Eigen::Vector3d(-0.06, -0.04, 0));
  b.set_positions(moved);
  CHECK(b.motion_since_vertex_refit() > 0.05);
  CHECK(check(a, b, 0.03, Swept::all) > 100);
}

TEST_CASE("vertex sweep: a large surface and a small one far below its size") {
  const Surface ground = surface_of(cloth(100, 1, 3));
  const Surface pebble = surface_of(mapped(shape_of(models::sphere(12, 8)), 0.02, {0.4, 0.3, 0.01}));
  CHECK(check(ground, pebble, 0.01, Swept::all) > 10);
  CHECK(check(pebble, ground, 0.01, Swept::all) > 10);
}

TEST_CASE("vertex sweep: surfaces that lie along each other are walked") {
  const Surface a = surface_of(cloth(70, 1, 4));
  const Surface b = surface_of(mapped(cloth(70, 1, 5), 1, {0, 0, 0.004}));
  CHECK(check(a, b, 0.03, Swept::too_many) > 1000);
  // Few vertices, all of them near all others.
  const Surface c = surface_of(cloth(40, 0.01, 6));
  const Surface d = surface_of(cloth(40, 0.01, 7));
  CHECK(check(c, d, 0.004, Swept::too_many) > 1000);
}

TEST_CASE("vertex sweep: stops where the budget does") {
  const Surface a = surface_of(cloth(100, 1, 1));
  const Surface b = surface_of(mapped(cloth(95, 1, 2), 1, {0.8, 0.85, 0.005}));
  const std::uint64_t whole = sweep(a, b, 0.03).counters.region_pairs_tested;
  CHECK(whole > 20);
  for (std::uint64_t limit = 0; limit <= whole + 1; ++limit) {
    const SweepRun run = sweep(a, b, 0.03, limit);
    CHECK(run.swept == (limit < whole ? Swept::out_of_budget : Swept::all));
    CHECK(run.counters.region_pairs_tested == std::min(limit, whole));
    CHECK(run.pairs.empty() == (limit < whole));
  }
  PairQuery query = query_of(ContactDetail::vertices, 0.03);
  query.work_limit = whole - 1;
  const PairAnswer answer = detect(a, b, query);
  CHECK_FALSE(answer.complete);
  CHECK(answer.contacts.empty());
}

}  // namespace graze::tests
