#pragma once

#include <graze/report.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/contact_limit.hpp"
#include "base/task_pool.hpp"
#include "broad_phase/broad_phase.hpp"
#include "objects/object_store.hpp"
#include "objects/object_summary.hpp"
#include "pairs/pair_filter.hpp"
#include "pairs/pair_job.hpp"
#include "pairs/pair_selection.hpp"
#include "pairs/self_pairs.hpp"

namespace graze {

/// The pairs of a scene's objects. Of the n(n-1)/2 pairs only those that may be close have an entry (the
/// paper's numcd). Stepping thread only.
class PairTable {
 public:
  PairTable(const SceneSettings& settings, PairFilter& filter, ObjectStore& store)
      : store_(store),
        filter_(filter),
        may_rest_(!ContactLimit(settings).is_shared()),
        self_pairs_(settings) {}

  [[nodiscard]] PairFilter& filter() { return filter_; }

  /// Lists the pairs that have to be tested or reported. Also reads objects that promises or surveys left
  /// unread if they may be near after all. `previous` is the last report, and `tools` are the objects that
  /// ask for patches.
  PairList list(const FrameReport& previous, std::span<Object* const> tools, TaskPool& tasks,
                std::vector<Diagnostic>& diagnostics, StepStatistics& statistics);

  /// The summaries of all objects, of the last `list`.
  [[nodiscard]] const ObjectSummaries& summaries() const { return summaries_; }

  /// The jobs of the last `list`.
  [[nodiscard]] std::span<PairJob> jobs() { return jobs_; }

  /// Lets the next `list` look up the rows of the report that it is given.
  void forget_rows() { rows_frame_ = ~std::uint64_t{0}; }

  /// Begins the list of a report's rows, which are added in its order.
  void begin_rows(std::uint64_t frame);
  void add_row(const PairJob& job) { add_row(job.slots); }
  void add_rows(const LastRows& rows);
  /// Counts a row about which the next step has nothing to say.
  void pass_row() { ++row_count_; }

  /// Reserves memory for that many objects and pairs whose loose boxes meet. Call it before the step's `list`
  /// only.
  void reserve(std::size_t objects, std::size_t pairs, const PairMemoryRoom& room);
  /// Reserves memory for the sweeps of that many objects.
  void reserve_for_sweeps(std::size_t objects) { summaries_.reserve_for_sweeps(objects); }
  /// Reserves memory for what is remembered of pairs with solids.
  void reserve_for_solids() { selection_.reserve_for_solids(); }
  /// The bytes held. Of the fronts it counts only reserved memory.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// A pair of objects by Object::serial. The rows of a report ascend by it.
  using SerialPair = std::pair<std::uint64_t, std::uint64_t>;
  /// A pair in contact that ends because one of its objects was removed.
  struct EndedPair {
    SerialPair pair;
    std::uint32_t row;  ///< in the last report
  };

  void count_filtered(StepStatistics& statistics) const;
  void find_listed(const FrameReport& previous);
  void look_up_listed(const FrameReport& previous);
  void find_ended(const FrameReport& previous);
  [[nodiscard]] std::uint64_t serial_of(ObjectId id);
  void list_ended(SerialPair before);
  void read_near_objects(std::span<const SlotPair> pairs, std::span<Object* const> tools, TaskPool& tasks,
                         std::vector<Diagnostic>& diagnostics);
  void want(std::uint32_t slot);
  void want_near(const Object& tool);
  void list_jobs(std::span<const SelectedPair> selected, const FrameReport& previous);
  [[nodiscard]] PairJob job_of(const SelectedPair& selected, const FrameReport& previous) const;
  void add(PairJob job, const SelectedPair& selected);
  [[nodiscard]] bool says_something(PairJob& job) const;
  [[nodiscard]] bool is_unchanged(const PairJob& job) const;
  void count_jobs(StepStatistics& statistics) const;
  void add_row(SlotPair pair) { rows_.push_back({pair, row_count_++}); }

  ObjectStore& store_;
  PairFilter& filter_;
  const bool may_rest_;  ///< a pair may stand as it was without being tested, unless all share contacts
  std::uint64_t filter_version_ = ~std::uint64_t{0};  ///< of the last look for what is near and unread
  ObjectSummaries summaries_;
  BroadPhase broad_phase_;
  SelfPairs self_pairs_;
  PairSelection selection_;
  std::vector<PairJob> jobs_;
  std::vector<LastRows> last_rows_;
  std::vector<ListedPair> listed_;  ///< by the last report
  std::vector<ListedPair> rows_;    ///< by the report of `rows_frame_`
  std::uint64_t rows_frame_ = 0;
  std::uint32_t row_count_ = 0;  ///< of that report
  std::vector<EndedPair> ended_;
  std::size_t ended_listed_ = 0;  ///< of `ended_`
  std::vector<Object*> wanted_;   ///< to be read after all
};

}  // namespace graze
