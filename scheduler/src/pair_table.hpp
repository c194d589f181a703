#pragma once

#include <graze/report.hpp>
#include <span>
#include <vector>

#include "broad_phase.hpp"
#include "object_store.hpp"
#include "pair_filter.hpp"
#include "pair_job.hpp"
#include "pair_memory.hpp"
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
  /// report, of the pairs of `was_listed`.
  std::span<const PairJob> list(const FrameReport& previous, TaskPool& tasks,
                                std::vector<Diagnostic>& diagnostics, StepStatistics& statistics);
  /// Ends a step: the jobs that made it into its report, in order.
  void was_listed(std::span<const PairJob* const> jobs);

  [[nodiscard]] std::size_t byte_count() const { return memories_.byte_count(); }

 private:
  using Key = PairMemories::Key;

  void read_what_is_near(std::span<const ObjectPair> pairs, TaskPool& tasks,
                         std::vector<Diagnostic>& diagnostics);
  void list_job(Object& a, Object& b, const PairReport* last, StepStatistics& statistics);
  [[nodiscard]] bool is_unchanged(const PairJob& job) const;
  [[nodiscard]] Object* object_of(std::uint64_t serial) const;

  ObjectStore& store_;
  PairFilter filter_;
  BroadPhase broad_phase_;
  PairMemories memories_;
  std::vector<Key> last_keys_;  ///< of the pairs of the previous report, in its order
  std::vector<PairJob> jobs_;
  std::vector<Object*> wanted_;  ///< to be read after all
};

}  // namespace graze
