#include "listed_vertices.hpp"

#include <array>
#include <type_traits>

namespace graze {
namespace {

/// Calls `use` with the surface's points, which are floats or doubles.
template <typename Use>
auto with_points(const Surface& surface, const Use& use) {
  const PositionView positions = surface.positions();
  const std::uint32_t last = surface.mesh().vertex_count() - 1;
  if (positions.is_double())
    return use(kernels::PointArray<double>{static_cast<const double*>(positions.data()), last});
  return use(kernels::PointArray<float>{static_cast<const float*>(positions.data()), last});
}

}  // namespace

void bring(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
           kernels::Point* brought) {
  const kernels::PositionPasses& passes = kernels::position_passes();
  const kernels::PointFrame given = frame.for_points();
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    if constexpr (std::is_same_v<Number, float>)
      passes.bring_floats(points, vertices.data(), vertices.size(), given, brought);
    else
      passes.bring_doubles(points, vertices.data(), vertices.size(), given, brought);
  });
}

Box bring_in_rows(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
                  const kernels::PointRows& rows) {
  if (vertices.empty()) return {};
  const kernels::PositionPasses& passes = kernels::position_passes();
  const kernels::PointFrame given = frame.for_points();
  return with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) -> Box {
    std::array<Number, 4> low;
    std::array<Number, 4> high;
    if constexpr (std::is_same_v<Number, float>)
      passes.bring_floats_in_rows(points, vertices.data(), vertices.size(), given, rows, low.data(),
                                  high.data());
    else
      passes.bring_doubles_in_rows(points, vertices.data(), vertices.size(), given, rows, low.data(),
                                   high.data());
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  });
}

std::size_t InsideBox::find(std::span<const std::uint32_t> vertices, std::uint32_t* inside) const {
  const kernels::PositionPasses& passes = kernels::position_passes();
  return with_points(surface_, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    if constexpr (std::is_same_v<Number, float>) {
      return passes.listed_floats_inside(points, vertices.data(), vertices.size(), in_float_.low.data(),
                                         in_float_.high.data(), inside);
    } else {
      const std::array<double, 4> low{box_.min.x(), box_.min.y(), box_.min.z(), 0};
      const std::array<double, 4> high{box_.max.x(), box_.max.y(), box_.max.z(), 0};
      return passes.listed_doubles_inside(points, vertices.data(), vertices.size(), low.data(), high.data(),
                                          inside);
    }
  });
}

}  // namespace graze
