#pragma once

#include <cstddef>
#include <graze/export.hpp>
#include <memory>

#include "core/mesh/pair_room.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Answers queries about pairs of surfaces: DMV, DV and contact determination (paper, sections 3.2 and 3.3).
/// Keeps its working memory from query to query. One thread at a time. Any number of detectors may share the
/// surfaces.
class GRAZE_API PairDetector {
 public:
  PairDetector();
  ~PairDetector();
  PairDetector(PairDetector&&) noexcept;
  PairDetector& operator=(PairDetector&&) noexcept;

  /// Both surfaces have been refitted, by `refit_vertices` for the details `regions` and `vertices`, by
  /// `refit_faces` for the others: now for AccuracyMode::paper, otherwise ever. Bounds are the looser the
  /// further the surfaces have moved since. Where `wants_blocks` says so it is `make_blocks` instead, now, or
  /// `make_stretches`.
  /// `answer` is overwritten, its memory used again. The work is added to `counters`.
  ///
  /// `front` is that of an earlier query about this pair, or a new one, and is updated. It saves work and
  /// does not change the answer. Only in AccuracyMode::within it may change which of the allowed bounds are
  /// given.
  void detect(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
              PairAnswer& answer, PairCounters& counters);
  /// Detects without a front to start from or to keep.
  void detect(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer,
              PairCounters& counters);

  /// Lists the pair's distances of regions in `answer`, level by level, as PairQuery::region_distance_limit
  /// says. Both surfaces have been refitted now.
  void region_distances(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer);

  /// Makes as much room as `other` and this have needed, so that either could have done the work of both
  /// without taking memory.
  void reserve_as(const PairDetector& other);
  /// Makes room ahead of time.
  void reserve(const PairRoom& room);
  /// Makes further room ahead of time for pairs of that size that have a solid.
  void reserve_for_solids(const PairRoom& room);
  /// Makes further room ahead of time for pairs of that size whose way out is asked for.
  void reserve_for_ways_out(const PairRoom& room);
  /// Makes further room ahead of time for pairs of that size of which at most so many contacts are kept.
  void reserve_for_limit(std::size_t most, const PairRoom& room);
  /// Bytes of working memory held.
  [[nodiscard]] std::size_t byte_count() const;

  /// Bounds that need no search and no refit, for a pair whose turn does not come: an answer that is not
  /// complete.
  static void outer_bounds(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer);

 private:
  friend class LargePair;
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace graze
