#include "page/quantized_positions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace graze::io {
namespace {

constexpr double largest_coordinate = 0x1p120;  // graze takes no larger ones
constexpr int step_bits = 15;                   // of an object's size
constexpr int number_bits = 30;                 // of a number's largest absolute value
constexpr auto not_drawn = std::numeric_limits<std::int32_t>::min();

bool is_drawn(const Mesh& mesh, std::uint32_t vertex, const Eigen::Vector3d& point) {
  return mesh.is_used(vertex) && (point.array().abs() <= largest_coordinate).all();  // false for NaN
}

/// The bounding box of what is drawn.
struct DrawnBox {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void include(const Mesh& mesh, std::span<const Eigen::Vector3d> positions) {
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
      const Eigen::Vector3d& point = positions[vertex];
      if (!is_drawn(mesh, vertex, point)) continue;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  [[nodiscard]] bool has_points() const { return low.x() <= high.x(); }
  /// The longest side, 0 if nothing is drawn.
  [[nodiscard]] double size() const { return has_points() ? (high - low).maxCoeff() : 0; }
};

/// The largest power of two that is not above `size`, times a power of two.
double power_of_two(double size, int exponent) {
  return std::max(std::ldexp(1.0, std::ilogb(size) + exponent), std::numeric_limits<double>::min());
}

double step_for(const Mesh& mesh, std::span<const Eigen::Vector3d> first, double extent) {
  DrawnBox box;
  box.include(mesh, first);
  if (box.size() == 0) box.include(mesh, mesh.rest());
  const double step = power_of_two(box.size() > 0 ? box.size() : 1.0, -step_bits);
  return extent > 0 ? std::max(step, power_of_two(extent, -number_bits)) : step;
}

/// A multiple of the step where there is one, so that drawn positions need no rounding.
double origin_for(double centre, double step) {
  const double steps = std::round(centre / step);
  return std::abs(steps) < 0x1p52 ? steps * step : centre;
}

std::uint32_t zigzag(std::uint32_t difference) {
  return (difference << 1U) ^ (0U - (difference >> 31U));
}

/// Appends a frame in planes of bytes. `last` has the numbers of the frame before, and then those of this.
void append_frame(std::string& bytes, const std::vector<std::uint32_t>& numbers,
                  std::vector<std::uint32_t>& last) {
  const std::size_t begin = bytes.size();
  const std::size_t count = numbers.size();
  bytes.resize(begin + 4 * count);
  char* const planes = bytes.data() + begin;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t coded = zigzag(numbers[i] - last[i]);
    for (std::size_t plane = 0; plane < 4; ++plane)
      planes[plane * count + i] = static_cast<char>(coded >> 8 * plane & 0xffU);
  }
  last = numbers;
}

/// Turns the positions of a frame into numbers: all x, then all y, then all z.
void quantize_frame(const Mesh& mesh, std::span<const Eigen::Vector3d> positions, QuantizedPositions& result,
                    std::vector<std::uint32_t>& numbers) {
  const std::size_t count = positions.size();
  for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
    const Eigen::Vector3d& point = positions[vertex];
    const bool drawn = is_drawn(mesh, vertex, point);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      std::int32_t number = not_drawn;
      if (drawn) {
        const double steps = std::nearbyint((point[a] - result.origin[a]) / result.step);
        number = static_cast<std::int32_t>(steps);
        result.error = std::max(result.error, std::abs(point[a] - (result.origin[a] + result.step * steps)));
      }
      numbers[axis * count + vertex] = static_cast<std::uint32_t>(number);
    }
  }
}

}  // namespace

QuantizedPositions quantized(const Mesh& mesh, std::span<const SharedPositions> frames) {
  DrawnBox box;
  for (const SharedPositions& positions : frames) box.include(mesh, *positions);
  QuantizedPositions result;
  result.step = step_for(mesh, *frames.front(), box.size());
  if (box.has_points())
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      result.origin[axis] = origin_for(box.low[axis] / 2 + box.high[axis] / 2, result.step);
  std::vector<std::uint32_t> numbers(3 * frames.front()->size());
  std::vector<std::uint32_t> last(numbers.size(), 0);
  result.bytes.reserve(4 * numbers.size() * frames.size());
  for (const SharedPositions& positions : frames) {
    quantize_frame(mesh, *positions, result, numbers);
    append_frame(result.bytes, numbers, last);
  }
  return result;
}

}  // namespace graze::io
