#include "sweep/double_meeting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sweep/coplanar_cubic.hpp"
#include "sweep/touch_in_double.hpp"

namespace graze {
namespace {

using Answer = DoubleMeeting::Answer;

/// Whether all points of the first feature have a larger coordinate than all of the second one, or a smaller
/// one, at both ends of the motion. Nothing rounds.
bool apart_along_an_axis(SweptPair pair, const FeatureSweep& sweep) {
  const std::size_t of_first = pair == SweptPair::vertex_face ? 1 : 2;
  const auto sides = [&](const std::array<Eigen::Vector3d, 4>& points, int axis) {
    double low = points[0][axis];
    double high = low;
    for (std::size_t i = 1; i < of_first; ++i) {
      low = std::min(low, points[i][axis]);
      high = std::max(high, points[i][axis]);
    }
    bool all_above = true;
    bool all_below = true;
    for (std::size_t i = of_first; i < 4; ++i) {
      all_above = all_above && points[i][axis] > high;
      all_below = all_below && points[i][axis] < low;
    }
    return all_above ? 1 : all_below ? -1 : 0;
  };
  for (int axis = 0; axis < 3; ++axis)
    if (const int side = sides(sweep.start, axis); side != 0 && side == sides(sweep.end, axis)) return true;
  return false;
}

/// A part of the motion.
struct Part {
  double low = 0;
  double high = 1;
  CoplanarCubic cubic;
  int halvings = 0;
};

/// An interval of time as a ball. The middle rounds by 2^-54 at most.
Ball ball_between(double low, double high) {
  return {low + (high - low) / 2, (high - low) / 2 + 0x1p-53};
}

class SearchInDouble {
 public:
  SearchInDouble(SweptPair pair, const FeatureSweep& sweep, double tolerance)
      : pair_(pair), sweep_(&sweep), tolerance_(tolerance), cubic_(CoplanarCubic::of(pair, sweep)) {}

  DoubleMeeting run() {
    if (cubic_.roots() == CoplanarCubic::Roots::none) return {Answer::discarded, {}};
    if (cubic_.sign_of(cubic_.coefficient[0]) == 0 && touch_at(Ball(0)) != CertainTouch::no) return {};
    parts_[count_++] = {0, 1, cubic_, 0};
    while (count_ > 0) {
      const Part part = parts_[--count_];
      const DoubleMeeting found = search(part);
      if (found.answer != Answer::apart) return found;
    }
    return {Answer::apart, {}};
  }

 private:
  /// Unsure, that the features meet in this part, or that they do not or may in its halves.
  DoubleMeeting search(const Part& part) {
    const CoplanarCubic::Roots roots = part.cubic.roots();
    if (roots == CoplanarCubic::Roots::none) return {Answer::apart, {}};
    if (roots == CoplanarCubic::Roots::one) return meeting_at_root(part);
    if (touch_at(ball_between(part.low, part.high)) == CertainTouch::no) return {Answer::apart, {}};
    if (part.halvings == CoplanarCubic::most_halvings || halvings_ == most_halvings) return {};
    ++halvings_;
    const double middle = part.low + (part.high - part.low) / 2;
    const std::array<CoplanarCubic, 2> halves = part.cubic.halves();
    parts_[count_++] = {middle, part.high, halves[1], part.halvings + 1};
    parts_[count_++] = {part.low, middle, halves[0], part.halvings + 1};
    return {Answer::apart, {}};
  }

  [[nodiscard]] DoubleMeeting meeting_at_root(const Part& part) const {
    const double root = rough_root(part);
    const int before = part.cubic.sign_of(part.cubic.coefficient[0]);
    double low = part.low;
    double high = part.high;
    double off = 0x1p-52;
    while (off < part.high - part.low) {
      if (low == part.low && root - off > low && sign_at(root - off) == before) low = root - off;
      if (high == part.high && root + off < high && sign_at(root + off) == -before) high = root + off;
      if (low > part.low && high < part.high) break;
      off *= 4;
    }
    if (high - low > tolerance_) return {};
    switch (touch_at(ball_between(low, high))) {
      case CertainTouch::no:
        return {Answer::apart, {}};
      case CertainTouch::if_coplanar:
        return {Answer::meets, {low, high, ImpactStatus::certain}};
      case CertainTouch::unsure:
        break;
    }
    return {};
  }

  /// The root of a part that has one, without any certainty: by Newton's method between bounds.
  [[nodiscard]] double rough_root(const Part& part) const {
    const bool rises = part.cubic.coefficient[0] < 0;
    const std::array<double, 4>& b = cubic_.coefficient;
    double low = part.low;
    double high = part.high;
    double time = low + (high - low) / 2;
    for (int i = 0; i < 16; ++i) {
      const double value = cubic_.value_at(time);
      ((value < 0) == rises ? low : high) = time;
      const double rest = 1 - time;
      const double slope =
          3 * (rest * rest * (b[1] - b[0]) + 2 * rest * time * (b[2] - b[1]) + time * time * (b[3] - b[2]));
      const double last = time;
      time -= value / slope;
      if (!(time >= low && time <= high)) time = low + (high - low) / 2;
      if (std::abs(time - last) <= 0x1p-53) break;
    }
    return time;
  }

  [[nodiscard]] int sign_at(double time) const { return cubic_.sign_of(cubic_.value_at(time)); }
  [[nodiscard]] CertainTouch touch_at(const Ball& time) const {
    return touch_in_double(pair_, *sweep_, time);
  }

  static constexpr int most_halvings = 24;

  SweptPair pair_;
  const FeatureSweep* sweep_;
  double tolerance_;
  CoplanarCubic cubic_;
  std::array<Part, CoplanarCubic::most_halvings + 1> parts_;  ///< still to be searched, the first one last
  std::size_t count_ = 0;
  int halvings_ = 0;
};

}  // namespace

DoubleMeeting meeting_in_double(SweptPair pair, const FeatureSweep& sweep, double tolerance) {
  if (apart_along_an_axis(pair, sweep)) return {Answer::discarded, {}};
  return SearchInDouble(pair, sweep, tolerance).run();
}

}  // namespace graze
