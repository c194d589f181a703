#pragma once

#include <cstddef>
#include <graze/export.hpp>
#include <memory>

#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/pair_detector.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A query about one pair of large surfaces, cut into slices that any threads may run at once. Its answer is
/// that of PairDetector::detect, bit for bit. Where PairQuery::region_distance_limit asks for distances of
/// regions, these are those of PairDetector::region_distances. How it is cut depends on the surfaces and the
/// query only.
///
///     large.begin(a, b, query, front, answer);
///     while (!large.advance(detector, counters))
///       for (i in 0 … large.slice_count() - 1)  // at once, in any order, each with a detector of its own
///         large.run_slice(i, detector, counters);
///
/// One thread at a time but for `run_slice`, of which calls with different numbers may overlap.
class GRAZE_API LargePair {
 public:
  /// From how many vertices of both surfaces on a pair is worth being cut.
  static constexpr std::uint32_t least_vertex_count = 4096;

  LargePair();
  ~LargePair();
  LargePair(LargePair&&) noexcept;
  LargePair& operator=(LargePair&&) noexcept;

  /// Begins a query as of PairDetector::detect and region_distances. The arguments that are referred to have
  /// to stay until it is answered.
  void begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
             PairAnswer& answer);
  /// Does the work that is not cut. True: the answer is there. False: there are slices to be run.
  bool advance(PairDetector& detector, PairCounters& counters);
  [[nodiscard]] std::size_t slice_count() const;
  void run_slice(std::size_t index, PairDetector& detector, PairCounters& counters);

  /// Bytes of working memory held.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace graze
