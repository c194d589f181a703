#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <numbers>

namespace graze::scenes {

/// splitmix64: the same numbers from every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  /// 0 to count - 1, where count > 0.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1p-53;
  }
  bool chance(double probability) { return between(0, 1) < probability; }
  /// Each coordinate between them.
  Eigen::Vector3d vector(double low, double high) {
    const double x = between(low, high);
    const double y = between(low, high);
    return {x, y, between(low, high)};
  }
  Eigen::Matrix3d turn() {
    const double angle = between(0, 2 * std::numbers::pi);
    return Eigen::AngleAxisd(angle, vector(-1, 1).normalized()).toRotationMatrix();
  }

 private:
  std::uint64_t state_;
};

}  // namespace graze::scenes
