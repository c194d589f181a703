#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <ranges>
#include <type_traits>

namespace graze {

/// A point type whose memory is three floats or three doubles and nothing else.
template <typename Point>
concept PackedPoint = std::same_as<Point, Eigen::Vector3f> || std::same_as<Point, Eigen::Vector3d> ||
    std::same_as<Point, std::array<float, 3>> || std::same_as<Point, std::array<double, 3>>;

/// Positions in somebody else's memory: `size()` points of three consecutive floats or doubles, each
/// `stride_bytes()` after the one before. Owns nothing; the memory must outlive the view's use.
class PositionView {
 public:
  PositionView() = default;

  /// `first` points at the x of point 0; y and z follow it.
  PositionView(const float* first, std::size_t count, std::size_t stride_bytes = 3 * sizeof(float))
      : first_(first), count_(count), stride_bytes_(stride_bytes), is_double_(false) {}
  PositionView(const double* first, std::size_t count, std::size_t stride_bytes = 3 * sizeof(double))
      : first_(first), count_(count), stride_bytes_(stride_bytes) {}

  /// A vector, array or span of Eigen::Vector3f, Eigen::Vector3d, std::array<float, 3> or std::array<double,
  /// 3>.
  template <std::ranges::contiguous_range Points>
  requires std::ranges::sized_range<Points> && PackedPoint<std::ranges::range_value_t<Points>> PositionView(
      const Points& points)  // NOLINT(google-explicit-constructor): a range of points is its view
      : first_(std::ranges::data(points)),
        count_(std::ranges::size(points)),
        stride_bytes_(sizeof(std::ranges::range_value_t<Points>)),
        is_double_(sizeof(std::ranges::range_value_t<Points>) == 3 * sizeof(double)) {}

  [[nodiscard]] const void* data() const { return first_; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::size_t stride_bytes() const { return stride_bytes_; }
  [[nodiscard]] bool is_double() const { return is_double_; }

  /// Point `index` in double (a float converts exactly). No bounds check.
  [[nodiscard]] Eigen::Vector3d operator[](std::size_t index) const {
    const auto* point = static_cast<const std::byte*>(first_) + index * stride_bytes_;
    if (is_double_) {
      std::array<double, 3> xyz;
      std::memcpy(xyz.data(), point, sizeof xyz);
      return {xyz[0], xyz[1], xyz[2]};
    }
    std::array<float, 3> xyz;
    std::memcpy(xyz.data(), point, sizeof xyz);
    return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])};
  }

 private:
  const void* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_bytes_ = 0;
  bool is_double_ = true;
};

}  // namespace graze
