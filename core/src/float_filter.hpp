#pragma once

#include <algorithm>
#include <graze/box.hpp>
#include <graze/surface.hpp>
#include <limits>
#include <vector>

#include "arithmetic.hpp"
#include "feature_block.hpp"
#include "filter_frame.hpp"
#include "working_memory.hpp"

namespace graze {

/// The box of the corners of a feature.
Box box_of(const Surface& surface, Part part, std::uint32_t index);

/// The features of one kind of one leaf.
template <typename Block>
struct FeaturesOf {
  const Surface& surface;
  const Block& features;
};

struct FloatFilterScratch {
  std::vector<std::uint32_t> index;
  std::vector<float> bound;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.index, self.bound);
  }
  void reserve(const PairRoom& room) {
    const std::size_t most = std::max({room.leaf_vertices, room.leaf_edges, 2 * room.leaf_faces});
    index.reserve(most);
    bound.reserve(most);
  }
};

/// Lets the float kernels look at all pairs of two blocks of features, and hands on what they leave. A quad
/// is handed on once, by one of its triangles.
///
/// `range.limit()` is the distance from which on a pair is of no interest; it may shrink meanwhile.
/// `range.left_out(limit)` is told when something further than that was discarded, and `range.keep(lower)` is
/// asked, with a bound from double, about features that are too large for float.
template <typename Range>
class FloatFilter {
 public:
  FloatFilter(const FilterFrame& frame, Range& range, FloatFilterScratch& scratch, DecisionCount& count)
      : frame_(frame), range_(range), scratch_(scratch), count_(count) {}

  /// Calls `visit(i, j)` for every feature i of `rows` and j of `columns` that `kernel` does not find to be
  /// beyond the range's limit.
  template <typename Rows, typename Columns, typename Kernel, typename Visit>
  void near(const FeaturesOf<Rows>& rows, const FeaturesOf<Columns>& columns, Kernel kernel,
            const Visit& visit) {
    const auto keep = [&](float bound, const auto& lower_in_double) {
      if (bound == untrusted) return range_.keep(lower_in_double());
      const double limit = range_.limit();
      if (bound < local(limit)) return true;
      range_.left_out(limit);
      ++count_.discarded_in_float;
      return false;
    };
    const kernels::Survivors survivors = room_for(columns.features.count());
    if (columns.features.count() == 0) return;
    for (std::size_t row = 0; row < rows.features.count(); ++row) {
      const double limit = range_.limit();
      const std::size_t found =
          kernel(row_of(rows.features, row), columns.features.block(), local(limit), survivors);
      if (hand_on(rows, columns, row, found, keep, visit) > 0) range_.left_out(limit);
    }
  }

  /// The same for every segment i of `rows` and triangle j of `columns` that may touch.
  template <typename Visit>
  void touching(const FeaturesOf<SegmentBlock>& rows, const FeaturesOf<TriangleBlock>& columns,
                const Visit& visit) {
    const auto keep = [](float bound, const auto& lower_in_double) {
      return bound != untrusted || lower_in_double() == 0;
    };
    const kernels::Block block = columns.features.touching_block();
    const kernels::Survivors survivors = room_for(block.count);
    if (block.count == 0) return;
    const auto kernel = kernels::filter().maybe_pierced;
    for (std::size_t row = 0; row < rows.features.touching(); ++row) {
      const std::size_t found = kernel(row_of(rows.features, row), block, survivors);
      hand_on(rows, columns, row, found, keep, visit);
    }
  }

 private:
  /// A limit in the frame. It mostly is the one of the last call.
  float local(double limit) {
    if (limit != limit_) {
      limit_ = limit;
      local_limit_ = frame_.to_local_limit(limit);
    }
    return local_limit_;
  }

  static constexpr float untrusted = -std::numeric_limits<float>::infinity();

  kernels::Survivors room_for(std::size_t columns) {
    if (scratch_.index.size() < columns) {
      scratch_.index.resize(columns);
      scratch_.bound.resize(columns);
    }
    return {scratch_.index.data(), scratch_.bound.data()};
  }

  /// Visits the first `found` survivors that `keep` does not take out; how many owners none survived of.
  template <typename Rows, typename Columns, typename Keep, typename Visit>
  std::size_t hand_on(const FeaturesOf<Rows>& rows, const FeaturesOf<Columns>& columns, std::size_t row,
                      std::size_t found, const Keep& keep, const Visit& visit) {
    const std::size_t owners = columns.features.owner_count();
    std::size_t survived = 0;
    for (std::size_t k = 0; k < found; ++k) {
      const std::size_t column = scratch_.index[k];
      const std::uint32_t owner = columns.features.owner(column);
      float bound = scratch_.bound[k];
      for (; k + 1 < found && columns.features.owner(scratch_.index[k + 1]) == owner; ++k)
        bound = std::min(bound, scratch_.bound[k + 1]);
      ++survived;
      const auto lower_in_double = [&] {
        return lower_distance(box_of(rows.surface, rows.features.part(), rows.features.owner(row)),
                              box_of(columns.surface, columns.features.part(), owner));
      };
      if (keep(bound, lower_in_double)) visit(row, column);
    }
    count_.discarded_in_float += owners - survived;
    return owners - survived;
  }

  const FilterFrame& frame_;
  double limit_ = -1;  ///< none yet
  float local_limit_ = 0;
  Range& range_;
  FloatFilterScratch& scratch_;
  DecisionCount& count_;
};

}  // namespace graze
