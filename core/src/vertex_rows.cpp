#include "vertex_rows.hpp"

#include <algorithm>

namespace graze {
namespace {

/// So many pairs are looked at between two looks at what is left; or those of one row.
constexpr std::size_t pairs_at_once = 4096;

/// Looks at some of the rows, which have so many pairs.
void add_some(const SurfacePair& pair, double limit, const VertexRows& vertices, float reach,
              std::size_t begin, std::size_t end, std::size_t pairs, VertexRowsScratch& scratch,
              std::vector<ContactName>& names) {
  const auto [rows, points] = vertices;
  const std::size_t found = kernels::filter().near_rows(
      rows.block(), begin, end, points.block(), scratch.first.data(), scratch.last.data(), reach * reach,
      {scratch.near_row.data(), scratch.near_point.data()});
  pair.count.discarded_in_float += pairs - found;
  for (std::size_t k = 0; k < found; ++k) {
    const auto name = ContactName::of(vertex_piece(rows.vertex(scratch.near_row[k])),
                                      vertex_piece(points.vertex(scratch.near_point[k])));
    if (is_closer_than(pair, name, limit)) names.push_back(name);
  }
}

}  // namespace

void VertexRowsScratch::make_room(std::size_t rows, std::size_t points) {
  for (auto* const of_rows : {&first, &last})
    if (of_rows->size() < rows) of_rows->resize(rows);
  const std::size_t pairs = std::max(points, pairs_at_once);
  for (auto* const of_pairs : {&near_row, &near_point})
    if (of_pairs->size() < pairs) of_pairs->resize(pairs);
}

float reach_of(const FilterFrame& frame, const Box& box, double limit) {
  return frame.to_local_limit(limit) + 2 * frame.size_of(box) * kernels::margin;
}

void add_close_rows(const SurfacePair& pair, double limit, const VertexRows& vertices, float reach,
                    VertexRowsScratch& scratch, std::vector<ContactName>& names) {
  const std::size_t rows = vertices.rows.count();
  for (std::size_t begin = 0; begin < rows;) {
    std::size_t end = begin;
    std::size_t pairs = 0;
    for (; end < rows; ++end) {
      const std::size_t more = scratch.last[end] - scratch.first[end];
      if (pairs + more > scratch.near_row.size()) break;
      pairs += more;
    }
    add_some(pair, limit, vertices, reach, begin, end, pairs, scratch, names);
    begin = end;
  }
}

}  // namespace graze
