#include "sweep/exact_meeting.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/compiler.hpp"
#include "sweep/first_root.hpp"

namespace graze {
namespace {

/// A vertex and a segment of which the vertex is no end.
struct Incidence {
  int point;
  Edge segment;
};
constexpr std::array<Incidence, 3> of_vertex_face = {{{0, {1, 2}}, {0, {2, 3}}, {0, {3, 1}}}};
constexpr std::array<Incidence, 4> of_edge_edge = {{{0, {2, 3}}, {1, {2, 3}}, {2, {0, 1}}, {3, {0, 1}}}};

std::span<const Incidence> incidences_of(SweptPair pair) {
  if (pair == SweptPair::vertex_face) return of_vertex_face;
  return of_edge_edge;
}

template <typename Number>
class ExactMeeting {
 public:
  ExactMeeting(SweptPair pair, const FeatureSweep& sweep, std::uint64_t budget)
      : pair_(pair), budget_(budget), polynomials_(sweep) {}

  std::optional<SweptMeeting> find() {
    const Polynomial<Number> volume = polynomials_.volume(pair_);
    const TimeAsNumber<Number> start = {Number(0)};
    if (start.sign(volume) == 0 && touch(pair_, signs_at(start, Ball(0))))
      return SweptMeeting{0, 0, ImpactStatus::at_start};
    if (volume.is_zero()) return meeting_in_plane();
    consider(volume, [&](const auto& time, const Ball& near) { return touch(pair_, signs_at(time, near)); });
    return first_;
  }

 private:
  template <typename Time>
  [[nodiscard]] ExactSigns<Number, Time> signs_at(const Time& time, const Ball& near) const {
    return {polynomials_, time, near};
  }

  /// The four points always lie in a plane. The first contact is then that of a vertex and a segment.
  std::optional<SweptMeeting> meeting_in_plane() {
    for (const Incidence& incidence : incidences_of(pair_)) {
      const Edge first = {incidence.point, incidence.segment.from};
      const Edge second = {incidence.point, incidence.segment.to};
      const auto touches = [&](const auto& time, const Ball& near) {
        return lies_on_segment(signs_at(time, near), incidence.point, incidence.segment);
      };
      const auto crossing = [&](int axis) { return polynomials_.cross(first, second, axis); };
      if (consider_first(crossing, touches)) continue;
      // The three points always lie on a line. Their first contact is that of two points.
      consider_first([&](int axis) { return polynomials_.component(first, axis); }, touches);
      consider_first([&](int axis) { return polynomials_.component(second, axis); }, touches);
    }
    return first_;
  }

  /// Considers the roots of the first of three polynomials that is not zero everywhere. Returns whether there
  /// is one.
  template <typename PolynomialOf, typename Condition>
  bool consider_first(const PolynomialOf& polynomial_of, const Condition& holds) {
    for (int axis = 0; axis < 3; ++axis) {
      const Polynomial<Number> polynomial = polynomial_of(axis);
      if (polynomial.is_zero()) continue;
      consider(polynomial, holds);
      return true;
    }
    return false;
  }

  /// Takes the first root at which a condition holds, if it is the first of all.
  template <typename Condition>
  void consider(const Polynomial<Number>& polynomial, const Condition& holds) {
    std::optional<SweptMeeting> meeting = FirstRoot<Number, Condition>(polynomial, holds, budget_).find();
    const TimeAsNumber<Number> end = {Number(1)};
    if (!meeting && !first_ && end.sign(polynomial) == 0 && holds(end, Ball(1)))
      meeting = SweptMeeting{1, 1, ImpactStatus::certain};
    if (!meeting) return;
    first_ = first_ ? earlier(*first_, *meeting) : *meeting;
  }

  /// Bounds of the earlier one of two meetings. One that is only possible counts if it begins earlier.
  static SweptMeeting earlier(const SweptMeeting& left, const SweptMeeting& right) {
    const bool left_first =
        left.lower != right.lower ? left.lower < right.lower : left.status == ImpactStatus::certain;
    SweptMeeting first = left_first ? left : right;
    if (left.status == right.status) first.upper = std::min(left.upper, right.upper);
    return first;
  }

  SweptPair pair_;
  std::uint64_t budget_;
  SweptPolynomials<Number> polynomials_;
  std::optional<SweptMeeting> first_;
};

/// How many bits there are from the highest to the lowest one of all coordinates.
int bits_of(const FeatureSweep& sweep) {
  int highest = std::numeric_limits<int>::min();
  int lowest = std::numeric_limits<int>::max();
  for (const auto* const points : {&sweep.start, &sweep.end})
    for (const Eigen::Vector3d& point : *points)
      for (const double coordinate : point) {
        if (coordinate == 0) continue;
        int exponent = 0;
        const double fraction = std::frexp(coordinate, &exponent);
        const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::abs(fraction), 53));
        highest = std::max(highest, exponent);
        lowest = std::min(lowest, exponent - 53 + std::countr_zero(mantissa));
      }
  return std::max(highest, lowest) - lowest;
}

/// Coordinates of so many bits need no more than the capacity of Exact, 64 · 192 bits: (180 + 8) · 61 bits.
constexpr int most_bits = 180;

/// Finds a meeting with numbers of one capacity. It is never inlined: its numbers take stack only where they
/// are needed (docs/numerics.md).
template <typename Number>
GRAZE_NEVER_INLINE std::optional<SweptMeeting> find_meeting(SweptPair pair, const FeatureSweep& sweep,
                                                            std::uint64_t budget) {
  return ExactMeeting<Number>(pair, sweep, budget).find();
}

/// No more of these are made, whatever the budget, so that times between doubles fit too.
constexpr std::uint64_t most_subdivisions = 1024;

}  // namespace

std::optional<SweptMeeting> exact_meeting(SweptPair pair, const FeatureSweep& sweep,
                                          std::uint64_t exact_budget) {
  const std::uint64_t budget = std::min(exact_budget, most_subdivisions);
  if (bits_of(sweep) <= most_bits) return find_meeting<Exact>(pair, sweep, budget);
  return find_meeting<WideExact>(pair, sweep, budget);
}

}  // namespace graze
