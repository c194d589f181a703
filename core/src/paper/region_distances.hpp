#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/pair_room.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"

namespace graze {

/// The distances of a pair that are alive (the paper's cd, section 3.2). Walks the regions level by level and
/// lists the pairs that pass the mode's test, until there are `query.region_distance_limit`. Pairs below
/// those that find no room are not tested.
///
/// A level is cut into slices by the pairs listed in the level above. A slice tests the pairs below its own
/// and writes the alive ones to its own memory, so slices may run on any threads in any order. `advance`
/// lists them in the slices' order. How a level is cut shows nowhere. Pairs below those that are listed when
/// the query's deadline comes are not tested.
class RegionDistances {
 public:
  /// Both surfaces are refitted now. What is pointed to stays until all is listed. `sliced`: a level may be
  /// of many slices.
  void begin(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer, bool sliced);

  /// Goes on to the next level of several slices. Returns true when all is listed instead. Otherwise each of
  /// the slices below `slice_count` is to be run once, and then this called again.
  bool advance();
  [[nodiscard]] std::size_t slice_count() const { return slice_count_; }
  void run_slice(std::size_t index);

  /// Reserves as much as another walk has. Neither is cut into slices.
  void reserve_as(const RegionDistances& other);
  void reserve(const PairRoom& room);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Slice {
    std::size_t begin = 0;  ///< a range of what is listed
    std::size_t end = 0;
    std::vector<RegionDistance> alive;
    std::uint64_t left_out = 0;  ///< alive, and certainly without room
  };
  class Test;

  Slice& add_slice(std::size_t begin, std::size_t end);
  [[nodiscard]] bool is_late() const;
  void gather();
  void cut();
  [[nodiscard]] std::size_t count_below(const RegionDistance& listed) const;

  const Surface* a_ = nullptr;
  const Surface* b_ = nullptr;
  PairQuery query_;
  PairAnswer* answer_ = nullptr;
  bool sliced_ = false;
  std::size_t level_begin_ = 0;  ///< of the last level among what is listed
  std::vector<Slice> slices_;    ///< kept longer than `slice_count_` for their memory
  std::size_t slice_count_ = 0;
};

}  // namespace graze
