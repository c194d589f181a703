#include "leaves/listed_vertices.hpp"

#include "surface/passes_for.hpp"

namespace graze {

void to_frame(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
              kernels::Point* converted) {
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    passes_for<Number>().to_frame(points, vertices.data(), vertices.size(), frame.for_points(), converted);
  });
}

}  // namespace graze
