// Features that move between two steps, against an oracle in exact rational arithmetic and against answers
// known by hand.

#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include "core/base/floating_point_scope.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/oracle/oracle_swept.hpp"
#include "support/random/random_sweeps.hpp"
#include "sweep/exact_meeting.hpp"
#include "sweep/moving_features.hpp"

namespace graze::tests {
namespace {

using oracle::MovingPoints;

std::optional<SweptMeeting> meet(const MovingPoints& points, SweepCounters& counters,
                                 const SweepPrecision& precision = {}) {
  const FeatureSweep sweep = {points.start, points.end};
  return points.are_edges ? meet_edge_edge(sweep, precision, counters)
                          : meet_vertex_face(sweep, precision, counters);
}
std::optional<SweptMeeting> meet(const MovingPoints& points, const SweepPrecision& precision = {}) {
  SweepCounters counters;
  return meet(points, counters, precision);
}

std::optional<double> approach(const MovingPoints& points, double gap) {
  const FeatureSweep sweep = {points.start, points.end};
  return points.are_edges ? approach_edge_edge(sweep, gap) : approach_vertex_face(sweep, gap);
}

template <typename Change>
MovingPoints changed(MovingPoints points, const Change& change) {
  for (auto* const at : {&points.start, &points.end})
    for (Eigen::Vector3d& point : *at) point = change(point);
  return points;
}

/// What differs from the oracle's answer, or nothing.
std::string fault_of(const std::optional<SweptMeeting>& meeting,
                     const std::optional<oracle::AlgebraicTime>& truth, double tolerance) {
  if (meeting.has_value() != truth.has_value()) return truth ? "a miss" : "they do not meet";
  if (!truth) return "";
  const bool at_start = truth->compare(0) == 0;
  if (meeting->status != (at_start ? ImpactStatus::at_start : ImpactStatus::certain)) return "another status";
  if (truth->compare(meeting->lower) < 0 || truth->compare(meeting->upper) > 0)
    return "outside of the bounds";
  return meeting->upper - meeting->lower <= tolerance ? "" : "bounds are too wide";
}

/// What is wrong about the answer for changed features. They are left out where the opposite change does not
/// give the same bits back.
template <typename Change, typename Opposite>
std::string fault_of_changed(const MovingPoints& points, const std::optional<oracle::AlgebraicTime>& truth,
                             const Change& change, const Opposite& opposite) {
  const MovingPoints there = changed(points, change);
  const MovingPoints back = changed(there, opposite);
  if (back.start != points.start || back.end != points.end) return "";
  return fault_of(meet(there), truth, 1e-6);
}

/// What is wrong about the answer far from the origin, or in other units.
std::string fault_of_changed(const MovingPoints& points, const std::optional<oracle::AlgebraicTime>& truth) {
  const auto moved_by = [](double length) {
    return [length](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.array() + length); };
  };
  const auto scaled_by = [](double scale) {
    return [scale](const Eigen::Vector3d& p) { return Eigen::Vector3d(p * scale); };
  };
  return fault_of_changed(points, truth, moved_by(0x1p40), moved_by(-0x1p40)) +
         fault_of_changed(points, truth, scaled_by(0x1p60), scaled_by(0x1p-60)) +
         fault_of_changed(points, truth, scaled_by(0x1p-60), scaled_by(0x1p60));
}

constexpr std::uint64_t random_sweeps = repeats(5000);

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "sweep: 20,000 random pairs of moving features meet when exact arithmetic says so, part", "",
    ((int sweep_part), sweep_part), 0, 1, 2, 3) {
  const FloatingPointScope scope;
  SweepCounters counters;
  std::uint64_t met = 0;
  std::uint64_t at_start = 0;
  for (std::uint64_t i = 0; i < random_sweeps; ++i) {
    const std::uint64_t seed = sweep_part * random_sweeps + i;
    const MovingPoints points = oracle::random_sweep(seed);
    const auto truth = oracle::first_meeting(points);
    const std::optional<SweptMeeting> meeting = meet(points, counters);
    const auto exact = exact_meeting(points.are_edges ? SweptPair::edge_edge : SweptPair::vertex_face,
                                     {points.start, points.end}, SweepPrecision{}.exact_budget);
    const std::string fault = fault_of(meeting, truth, 1e-6);
    const std::string exact_fault = fault_of(exact, truth, 0x1p-50);
    const std::string changed_fault = fault_of_changed(points, truth);
    if (!fault.empty() || !exact_fault.empty() || !changed_fault.empty())
      FAIL_CHECK("seed " << seed << ": " << fault << "; exact: " << exact_fault
                         << "; moved or scaled: " << changed_fault);
    if (meeting) ++met;
    if (meeting && meeting->status == ImpactStatus::at_start) ++at_start;
  }
  CHECK(met > random_sweeps / 5);
  CHECK(at_start > random_sweeps / 20);
  CHECK(counters.discarded > random_sweeps / 10);
  CHECK(counters.in_double > random_sweeps / 4);
  CHECK(counters.exact > random_sweeps / 10);
  CHECK(counters.undecided == 0);
}

TEST_CASE("sweep: features come near when exact distances say so") {
  const FloatingPointScope scope;
  std::uint64_t found = 0;
  std::uint64_t near = 0;
  for (std::uint64_t seed = 0; seed < repeats(2000); ++seed) {
    INFO("seed " << seed);
    const MovingPoints points = oracle::random_sweep(seed);
    const double gap = seed % 4 == 0 ? 0 : seed % 4 == 1 ? 0.25 : 0.01 * static_cast<double>(seed % 64);
    const std::optional<double> time = approach(points, gap);
    const auto is_above = [&](double at, double limit) {
      return oracle::squared_distance_at(points, at) >= oracle::Rational(limit) * oracle::Rational(limit);
    };
    for (int i = 0; i < 8; ++i)
      if (const double before = i / 8.0 * time.value_or(1.0); before > 0) CHECK(is_above(before, gap));
    CHECK(is_above(time.value_or(1), time == 0 ? 0 : gap));
    if (!time) continue;
    ++found;
    CHECK(!is_above(*time, gap + 0x1p-10));
    if (!is_above(*time, gap + 0x1p-20)) ++near;
    if (const auto meeting = meet(points)) CHECK(*time <= meeting->upper);
  }
  CHECK(found > repeats(2000) / 4);
  std::cout << "sweep: " << near << " of " << found << " times are those of the gap within 2^-20\n";
  CHECK(near >= found * 99 / 100);
}

TEST_CASE("sweep: a point that falls on a triangle meets it a quarter of the way") {
  MovingPoints points;
  points.start = {{{0.1, 0.2, 1}, {-2, -2, 0}, {2, -2, 0}, {0, 3, 0}}};
  points.end = points.start;
  points.end[0].z() = -3;
  const auto meeting = meet(points);
  REQUIRE(meeting.has_value());
  CHECK(meeting->status == ImpactStatus::certain);
  CHECK(meeting->lower <= 0.25);
  CHECK(meeting->upper >= 0.25);
  CHECK(meeting->upper - meeting->lower < 1e-12);
  const auto near = approach(points, 0.5);
  REQUIRE(near.has_value());
  CHECK(*near <= 0.125);
  CHECK(*near > 0.125 - 1e-12);
  points.end[0].z() = 0;
  CHECK(meet(points)->upper == 1);
  points.end[0].z() = 0x1p-1000;
  CHECK(!meet(points).has_value());
}

namespace {

/// A point that passes through a plane which turns. The volume is that of (3 t − 1)² − height.
MovingPoints grazing(double height) {
  MovingPoints points;
  const auto at = [&](double turn) -> std::array<Eigen::Vector3d, 4> {
    return {{{turn, 0, height}, {-4, -4, -4 * turn}, {4, -4, 4 * turn}, {0, 4, 0}}};
  };
  points.start = at(-1);
  points.end = at(2);
  return points;
}

}  // namespace

TEST_CASE("sweep: a point that only grazes a turning plane meets it once") {
  const auto grazes = meet(grazing(0));
  REQUIRE(grazes.has_value());
  CHECK(grazes->status == ImpactStatus::certain);
  CHECK(grazes->lower < 1.0 / 3);
  CHECK(grazes->upper >= 1.0 / 3);
  CHECK(!meet(grazing(-0x1p-120)).has_value());
  CHECK(!meet(grazing(-0x1p-1000)).has_value());
}

TEST_CASE("sweep: two times closer than doubles are told apart as far as the budget goes") {
  for (const double height : {0x1p-120, 0x1p-400}) {
    SweepPrecision precision;
    CHECK(meet(grazing(height), precision)->status == ImpactStatus::certain);
    precision.exact_budget = 0;
    SweepCounters counters;
    const auto meeting = meet(grazing(height), counters, precision);
    REQUIRE(meeting.has_value());
    CHECK(meeting->status == ImpactStatus::possible);
    CHECK(meeting->upper - meeting->lower <= 0x1p-50);
    CHECK(counters.exact == 1);
    CHECK(counters.undecided == 1);
  }
}

}  // namespace graze::tests
