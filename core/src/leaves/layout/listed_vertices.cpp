#include "leaves/layout/listed_vertices.hpp"

#include <algorithm>
#include <limits>

#include "surface/passes_for.hpp"

namespace graze {
namespace {

/// As the kernels do it, but turned.
void to_turned_frame(const Surface& surface, std::span<const std::uint32_t> vertices,
                     const FilterFrame& frame, kernels::Point* converted) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3f local = frame.to_local(surface.position(vertices[i])).cast<float>();
    const float size = std::max(local.cwiseAbs().maxCoeff(), kernels::least_size);
    if (size <= kernels::largest_size)
      converted[i] = {{local.x(), local.y(), local.z()}, size};
    else
      converted[i] = {{0, 0, 0}, std::numeric_limits<float>::infinity()};
  }
}

}  // namespace

void to_frame(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
              kernels::Point* converted) {
  if (frame.is_turned()) return to_turned_frame(surface, vertices, frame, converted);
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    passes_for<Number>().to_frame(points, vertices.data(), vertices.size(), frame.for_points(), converted);
  });
}

}  // namespace graze
