#pragma once

#include <tuple>
#include <vector>

#include "contact_name.hpp"
#include "filter_frame.hpp"
#include "local_vertices.hpp"

namespace graze {

/// Vertices of a surface a, the rows, and of b, the points.
struct VertexRows {
  const LocalVertices& rows;
  const LocalVertices& points;
};

/// The stretch of points that each row is compared with, and what a kernel leaves of them.
struct VertexRowsScratch {
  std::vector<std::uint32_t> first;  ///< by row
  std::vector<std::uint32_t> last;
  std::vector<std::uint32_t> near_row;
  std::vector<std::uint32_t> near_point;

  void make_room(std::size_t rows, std::size_t points);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.first, self.last, self.near_row, self.near_point);
  }
};

/// In a frame: vertices in `box` that are no nearer than this in float are certainly not nearer than `limit`.
float reach_of(const FilterFrame& frame, const Box& box, double limit);

/// Appends the pairs of each row and the points of its stretch that are strictly closer than `limit`, row by
/// row.
void add_close_rows(const SurfacePair& pair, double limit, const VertexRows& vertices, float reach,
                    VertexRowsScratch& scratch, std::vector<ContactName>& names);

}  // namespace graze
