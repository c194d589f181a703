#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <graze/impact.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "core/pair/pair_query.hpp"
#include "core/sweep/sweep_counters.hpp"
#include "core/sweep/sweep_precision.hpp"
#include "core/sweep/swept_surface.hpp"

namespace graze {

struct PairRoom;

/// The question about two surfaces, or one and itself, on their way through a step.
struct SweepQuery {
  SweepPrecision precision;
  /// The time is asked at which surfaces come that near. With 0 it is not.
  double gap = 0;
  /// The two surfaces are one. Features that share a vertex are left out, and each pair of features is named
  /// once, with the lower feature as a.
  bool is_self = false;
  /// Says which features are tested. It is null where all are.
  const FeatureFilter* groups = nullptr;
  /// The most impacts that an answer keeps: the earliest. 0: all.
  std::size_t impact_limit = 0;
  /// Region pairs that may be tested. Beyond it the answer is not complete.
  std::uint64_t work_limit = std::numeric_limits<std::uint64_t>::max();
  /// A sweep ends some tens of microseconds after its deadline. The answer is not complete then.
  std::chrono::steady_clock::time_point deadline = PairQuery::no_deadline;
};

/// The result for one pair, without its list. If it is not complete both times are 0.
struct SweepFinding {
  bool complete = true;
  std::size_t left_out = 0;   ///< impacts beyond the limit. The times are those of all
  double time_of_impact = 1;  ///< no features meet earlier
  double time_of_gap = 1;     ///< none come as near as the gap earlier
};

struct SweepAnswer : SweepFinding {
  std::vector<Impact> impacts{};  ///< sorted by (lower, kind, feature a, feature b). None if not complete

  /// Whether the surfaces may have met on the way, or come as near as the gap.
  [[nodiscard]] bool met() const { return !complete || !impacts.empty() || time_of_gap < 1; }
};

/// How much the sweeps of a pair, or of many, tested. Every member but `features` is a 64-bit counter.
struct SweepWork {
  std::uint64_t region_pairs_tested = 0;
  std::uint64_t feature_pairs_tested = 0;  ///< whose boxes meet on the way
  SweepCounters features;

  void add(const SweepWork& other) {
    region_pairs_tested += other.region_pairs_tested;
    feature_pairs_tested += other.feature_pairs_tested;
    features.add(other.features);
  }
};

/// Finds what features of two surfaces meet between two steps. Keeps its working memory from pair to pair.
/// One thread at a time. Any number may share the surfaces.
class GRAZE_API PairSweep {
 public:
  PairSweep();
  ~PairSweep();
  PairSweep(PairSweep&&) noexcept;
  PairSweep& operator=(PairSweep&&) noexcept;

  /// Both surfaces have boxes. `answer` is overwritten, its memory used again. The work is added to `work`.
  /// Each vertex of one surface is tested with each face of the other, and each edge with each edge. All
  /// impacts are found, in whatever order.
  void sweep(const MovingSurface& a, const MovingSurface& b, const SweepQuery& query, SweepAnswer& answer,
             SweepWork& work);

  /// Makes room for pairs of surfaces of the sizes that `room` says.
  void reserve(const PairRoom& room);
  /// Makes as much room as `other` has needed.
  void reserve_as(const PairSweep& other);
  /// Bytes of working memory held.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace graze
