#pragma once

#include <cstdint>
#include <cstring>

#include "kernels/vectors.hpp"

namespace graze {

/// Points of an array of coordinates, loaded so that one register holds three coordinates and the number that
/// follows them. Behind the last point there is no such number. To add one to each array made S5's steps,
/// which follow the arrays from object to object, a quarter slower, where two arrays no longer fitted where
/// one did. Kernels load points by a function of their own, since they share none with other translation
/// units.
template <typename Number>
class PointRegisters {
 public:
  GRAZE_VECTOR(Four, Number, 4);

  PointRegisters(const Number* numbers, std::size_t count)
      : numbers_(numbers), last_(static_cast<std::uint32_t>(count - 1)) {}

  [[nodiscard]] const Number* at(std::uint32_t point) const { return numbers_ + std::size_t{3} * point; }
  /// Not returned, since there is no register of four doubles everywhere.
  void load(std::uint32_t point, Four& loaded) const {
    const Number* const xyz = at(point);
    loaded = Four{xyz[0], xyz[1], xyz[2], xyz[2]};
    if (point != last_) std::memcpy(&loaded, xyz, sizeof loaded);
  }

 private:
  const Number* numbers_;
  std::uint32_t last_;
};

}  // namespace graze
