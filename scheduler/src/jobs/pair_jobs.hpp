#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/carrying.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
#include "jobs/last_contacts.hpp"
#include "jobs/nearest_contacts.hpp"
#include "jobs/pair_answers.hpp"
#include "pairs/pair_job.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// Runs a step's jobs on the task pool: DMV, DV and contact determination. Stepping thread only.
class PairJobs {
 public:
  using Clock = std::chrono::steady_clock;

  PairJobs(const SceneSettings& settings, TaskPool& tasks);

  /// Answers every job that tests its pair. Budgets of time began at `start`. Contacts will be written into
  /// `report`.
  void run(const PairList& list, std::uint64_t rules_version, Clock::time_point start,
           const LastContacts& last, ReportBuilder& report);

  /// The answer of a job that tested its pair, valid until `equalize_capacity`. Where `max_contacts` is set,
  /// the answers of the other jobs hold their contacts only.
  [[nodiscard]] const KeptAnswer& answer(std::size_t index) const { return answers_[index]; }
  /// The longest list of contacts, if it has at least `longest_copied` contacts and so is better adopted than
  /// copied. Otherwise it is null.
  [[nodiscard]] std::vector<Contact>* longest_list();
  [[nodiscard]] PairCounters counters() const;

  /// Gives all workers the capacity that any of them needed, so that a step like the last one allocates
  /// nothing, whichever worker gets which job. Discards the answers. Returns false if a time budget that
  /// began at `start` ended before all was done. The next step then keeps time back for it.
  [[nodiscard]] bool equalize_capacity(Clock::time_point start);
  /// Reserves memory for that many jobs, and for the contacts of all of them together.
  void reserve(std::size_t jobs, std::size_t contacts);
  /// Reserves memory for pairs with objects of that mesh, which may be solids.
  void reserve_for(const IndexedMesh& mesh, bool is_solid);
  /// The bytes held here, and the growth of the fronts in the pairs' memories.
  [[nodiscard]] std::size_t byte_count() const;
  /// The bytes held by the workers.
  [[nodiscard]] std::size_t thread_byte_count() const;

 private:
  /// The data of one worker. Only that worker touches it while jobs run.
  struct Worker {
    PairDetector detector;
    PairCounters counters;
    CarryingChoice carrying;
    PairAnswer answer;                ///< the answer of the current job
    std::deque<PairAnswer> too_long;  ///< unexpectedly long answers of this step, which are not copied
    /// The bytes by which fronts have grown since the scene began. Only the sum over all workers means
    /// something, since one worker may shrink a front that another has made grow.
    std::size_t front_bytes = 0;

    void reserve_as(const Worker& other);
    void reserve(const PairRoom& room);
  };
  struct LargeJob {
    std::uint32_t job = 0;
    std::optional<FeatureFilter> filter;  ///< what its query refers to, where faces are hidden
    LargePair pair;
    bool answered = false;
    std::size_t front_bytes = 0;  ///< the bytes of the front when the job began
  };
  /// A slice of a large pair.
  struct LargeSlice {
    std::uint32_t large;  ///< index into large_
    std::uint32_t slice;
  };

  /// The query refers to `filter` if faces of the pair are hidden, and no groups were ever ignored.
  [[nodiscard]] PairQuery query_of(const PairJob& job, std::optional<FeatureFilter>& filter) const;
  [[nodiscard]] std::size_t contact_limit() const;
  [[nodiscard]] bool chooses_carrying() const;
  void choose_carrying(std::uint32_t index, PairAnswer& answer, Worker& worker) const;
  [[nodiscard]] static bool is_large(const PairJob& job);
  void run_group(std::span<const std::uint32_t> jobs);
  void run_rounds_of_slices();
  void add_large(std::uint32_t index);
  [[nodiscard]] PairAnswer& answer_of_large(std::size_t index);
  void begin_large(std::size_t index, unsigned worker);
  void advance_large(std::size_t index, unsigned worker);
  void detect(std::uint32_t index, unsigned worker, std::uint64_t work_limit);
  void remember_answer(const PairJob& job, const PairAnswer& answer) const;
  [[nodiscard]] PairAnswer& answer_for(std::uint32_t index, Worker& worker);
  void store_answer(std::uint32_t index, PairAnswer& answer, unsigned worker);
  void lend_memory(ReportBuilder& report);
  void refer_to(std::uint32_t index, const PairAnswer& answer, unsigned worker);
  void reserve_workers();
  void keep_time_back(std::size_t last_contacts, ReportBuilder& report);
  void share_contacts(const LastContacts& last);
  [[nodiscard]] bool make_room_in_report(std::size_t contacts);
  [[nodiscard]] Clock::time_point deadline_now() const;
  bool owes_capacity_ = false;  ///< the last step had no time to equalize capacity
  [[nodiscard]] bool is_late() const;
  void sort_by_urgency();
  void run_by_urgency();
  void run_within_work(std::uint64_t budget);

  const SceneSettings& settings_;
  TaskPool& tasks_;
  std::span<const PairJob> jobs_;
  const LastContacts* last_ = nullptr;
  std::size_t pair_count_ = 0;  ///< the number of all pairs, those at rest included
  std::uint64_t rules_version_ = 0;
  Clock::time_point deadline_ =
      PairQuery::no_deadline;                   ///< without the time to write the contacts that are found
  std::atomic<std::size_t> contacts_found_{0};  ///< counted if there is a deadline
  std::vector<Contact>* lent_ = nullptr;        ///< the report's memory, lent to one job
  std::uint32_t lent_to_ = 0;                   ///< the job that has it
  NearestContacts nearest_;                     ///< of all jobs, if `max_contacts` is set
  std::mutex report_mutex_;
  ReportBuilder* report_ = nullptr;  ///< set if there is a deadline. It is guarded by `report_mutex_`
  std::size_t contacts_with_room_ =
      0;  ///< contacts that the report has room for. It is guarded by `report_mutex_`
  PairAnswers answers_;
  std::vector<std::uint32_t> order_;       ///< jobs that test their pairs; by urgency if there is a budget
  std::vector<std::uint32_t> small_jobs_;  ///< the small jobs of the current group
  std::vector<LargeJob> large_;  ///< the large jobs of the current group. It never shrinks, to keep memory
  std::size_t large_count_ = 0;
  std::vector<PairAnswer> large_answers_;  ///< the answers of all groups' large jobs. It never shrinks
  std::size_t large_answer_count_ = 0;     ///< the large answers of earlier groups
  std::vector<std::uint32_t> long_jobs_;   ///< small jobs with long lists in the last step, ascending
  std::vector<PairAnswer> long_answers_;   ///< the answers of long_jobs_. It never shrinks
  std::vector<LargeSlice> slices_;         ///< the slices of all large jobs of the group
  std::vector<Worker> workers_;
  PairRoom room_;               ///< the capacity that was reserved for each worker
  bool is_for_solids_ = false;  ///< whether it was reserved for pairs with solids, too
};

}  // namespace graze
