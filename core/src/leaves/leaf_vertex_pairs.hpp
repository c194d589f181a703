#pragma once

#include <limits>

#include "leaves/leaf_scratch.hpp"

namespace graze {

/// Calls `visit(vertex of a, vertex of b)` for the pairs of the leaves' vertices, without those certainly too
/// far for `range`. LeafFeaturePairs says what a range is asked and told.
template <typename Range, typename Visit>
void for_each_vertex_pair(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b,
                          LeafScratch& scratch, Range& range, const Visit& visit) {
  if (!scratch.select_near_vertices(pair, leaf_a, leaf_b, range)) return;
  const PointBlock& a = scratch.a.vertices.all();
  const PointBlock& b = scratch.b.vertices.all();
  FloatFilterScratch& lists = scratch.filter.lists;
  constexpr std::size_t laid_out = kernels::size_at<1> + 1;
  const kernels::Block columns = lists.gather(scratch.b.vertices, 0, laid_out);
  const kernels::Survivors survivors = lists.room_for_row(columns.count);
  for (std::size_t row = 0; row < scratch.a.vertices.count(); ++row) {
    const std::uint32_t i = scratch.a.vertices.index()[row];
    const kernels::Point point{{a.component(0, i), a.component(1, i), a.component(2, i)},
                               a.component(kernels::size_at<1>, i)};
    pair.check_time();
    const double limit = range.limit();
    const std::size_t found =
        kernels::filter().near_points(point, columns, scratch.frame.to_local_limit(limit), survivors);
    pair.count.discarded_in_float += columns.count - found;
    if (found < columns.count) range.left_out(limit);
    for (std::size_t k = 0; k < found; ++k) {
      const std::uint32_t j = scratch.b.vertices.index()[survivors.index[k]];
      const double now = range.limit();
      const float bound = survivors.bound[k];
      if (bound == -std::numeric_limits<float>::infinity()) {
        if (!range.keep(lower_distance(box_of(pair.a, FeatureRefKind::vertex, a.owner(i)),
                                       box_of(pair.b, FeatureRefKind::vertex, b.owner(j)))))
          continue;
      } else if (now < limit && bound >= scratch.frame.to_local_limit(now)) {
        range.left_out(now);
        ++pair.count.discarded_in_float;
        continue;
      }
      visit(a.owner(i), b.owner(j));
    }
  }
}

}  // namespace graze
