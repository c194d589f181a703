#include "listed_vertices.hpp"

#include <array>

#include "passes_for.hpp"

namespace graze {

void bring(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
           kernels::Point* brought) {
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    passes_for<Number>().bring(points, vertices.data(), vertices.size(), frame.for_points(), brought);
  });
}

Box bring_in_rows(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
                  const kernels::PointRows& rows) {
  if (vertices.empty()) return {};
  return with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) -> Box {
    std::array<Number, 4> low;
    std::array<Number, 4> high;
    passes_for<Number>().bring_in_rows(points, vertices.data(), vertices.size(), frame.for_points(), rows,
                                       low.data(), high.data());
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  });
}

std::size_t InsideBox::find(std::span<const std::uint32_t> vertices, std::uint32_t* inside) const {
  return with_points(surface_, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    const auto& box = std::get<BoxWithin<Number>>(boxes_);
    return passes_for<Number>().listed_inside(points, vertices.data(), vertices.size(), box.low.data(),
                                              box.high.data(), inside);
  });
}

}  // namespace graze
