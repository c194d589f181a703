#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/box.hpp>
#include <limits>

namespace graze {

/// A box whose bounds are floats or doubles and between which the same of these lie; coordinates are within
/// limits. The fourth of each is nothing.
template <typename Number>
struct BoxWithin {
  std::array<Number, 4> low{};
  std::array<Number, 4> high{};

  explicit BoxWithin(const Box& box) {
    constexpr Number most = std::numeric_limits<Number>::max();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = std::clamp<double>(box.min[static_cast<int>(axis)], -most, most);
      const double to = std::clamp<double>(box.max[static_cast<int>(axis)], -most, most);
      low[axis] = static_cast<Number>(from);
      high[axis] = static_cast<Number>(to);
      if (static_cast<double>(low[axis]) < from) low[axis] = std::nextafter(low[axis], most);
      if (static_cast<double>(high[axis]) > to) high[axis] = std::nextafter(high[axis], -most);
    }
  }
};

}  // namespace graze
