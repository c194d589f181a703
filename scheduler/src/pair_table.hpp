#pragma once

#include <graze/report.hpp>
#include <span>
#include <vector>

#include "broad_phase.hpp"
#include "object_store.hpp"
#include "object_summary.hpp"
#include "pair_filter.hpp"
#include "pair_job.hpp"
#include "pair_memory.hpp"
#include "pair_selection.hpp"
#include "task_pool.hpp"

namespace graze {

/// The n(n-1)/2 pairs of a scene's objects, of which only those that may be close have an entry (the paper's
/// numcd). Stepping thread only.
class PairTable {
 public:
  PairTable(const SceneSettings& settings, ObjectStore& store);

  [[nodiscard]] PairFilter& filter() { return filter_; }

  /// The pairs that have to be looked at or said something about, in the order of addition of a, then b.
  /// Reads objects that promises left unread, where they may be near after all. `previous` is the last
  /// report.
  std::span<const PairJob> list(const FrameReport& previous, TaskPool& tasks,
                                std::vector<Diagnostic>& diagnostics, StepStatistics& statistics);

  /// Makes room for so many objects, and pairs whose loose boxes meet, with fronts of up to `leaf_pairs`.
  /// Before a step's `list` only.
  void reserve(std::size_t objects, std::size_t pairs, std::size_t leaf_pairs);
  /// Of the fronts only what was reserved.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void read_what_is_near(std::span<const PlacePair> pairs, const FrameReport& previous, TaskPool& tasks,
                         std::vector<Diagnostic>& diagnostics);
  void list_jobs(std::span<const PlacePair> selected, const FrameReport& previous,
                 StepStatistics& statistics);
  void add_unselected(Object& a, Object& b, const PairReport& last);
  void add(PairJob& job, const ObjectSummary& a, const ObjectSummary& b);
  [[nodiscard]] bool is_unchanged(const PairMemory& last, const ObjectSummary& a,
                                  const ObjectSummary& b) const;

  ObjectStore& store_;
  PairFilter filter_;
  ObjectSummaries summaries_;
  BroadPhase broad_phase_;
  PairSelection selection_;
  PairMemories memories_;
  std::vector<PairJob> jobs_;
  std::vector<Object*> wanted_;  ///< to be read after all
};

}  // namespace graze
