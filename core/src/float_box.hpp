#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/box.hpp>
#include <limits>

namespace graze {

/// A box whose bounds are floats and between which the same floats lie; coordinates are within limits.
/// The fourth of each is nothing.
struct FloatBox {
  std::array<float, 4> low{};
  std::array<float, 4> high{};

  explicit FloatBox(const Box& box) {
    constexpr float most = std::numeric_limits<float>::max();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = std::clamp<double>(box.min[static_cast<int>(axis)], -most, most);
      const double to = std::clamp<double>(box.max[static_cast<int>(axis)], -most, most);
      low[axis] = static_cast<float>(from);
      high[axis] = static_cast<float>(to);
      if (static_cast<double>(low[axis]) < from) low[axis] = std::nextafter(low[axis], most);
      if (static_cast<double>(high[axis]) > to) high[axis] = std::nextafter(high[axis], -most);
    }
  }
};

}  // namespace graze
