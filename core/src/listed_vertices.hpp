#pragma once

#include <cstdint>
#include <graze/box.hpp>
#include <graze/surface.hpp>
#include <span>
#include <tuple>

#include "box_within.hpp"
#include "filter_frame.hpp"

namespace graze {

/// Listed vertices of a surface in a frame. Of those too large for the kernels the coordinates are left out,
/// and the size says so.
void bring(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
           kernels::Point* brought);

/// The same where none is too large, in rows of x, y and z. The box of them, in the scene.
Box bring_in_rows(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
                  const kernels::PointRows& rows);

/// Says which vertices of a surface are in a box, its border included; while the surface stays as it is.
class InsideBox {
 public:
  InsideBox(const Surface& surface, const Box& box) : surface_(surface), boxes_(box, box) {}
  /// Those of the listed vertices, in their order; how many. Room for all.
  std::size_t find(std::span<const std::uint32_t> vertices, std::uint32_t* inside) const;

 private:
  const Surface& surface_;
  std::tuple<BoxWithin<float>, BoxWithin<double>> boxes_;  ///< for the numbers that the surface has
};

}  // namespace graze
