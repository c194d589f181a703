#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/large_pair.hpp"
#include "core/search/pair_detector.hpp"
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

  /// Answers every job that is looked at; budgets began at `start`. `report` is where contacts will be put.
  void run(const PairList& list, std::uint64_t rules_version, Clock::time_point start,
           const FrameReport& previous, ReportBuilder& report);

  /// Of the job at that index, where it is looked at; until `equalize_capacity`. Where all contacts are
  /// limited, of the others the contacts.
  [[nodiscard]] const KeptAnswer& answer(std::size_t index) const { return answers_[index]; }
  /// The longest list of contacts that was not copied, where it is so long that it better never is; otherwise
  /// null.
  [[nodiscard]] std::vector<Contact>* longest_list();
  [[nodiscard]] PairCounters counters() const;

  /// Makes room, so that a step like the last takes no memory, whichever worker gets what. The answers are
  /// gone then. False where a time budget that began at `start` is over before all is done: the next step
  /// then keeps time back for it.
  [[nodiscard]] bool equalize_capacity(Clock::time_point start);
  /// Makes room for so many jobs, and contacts of all of them together.
  void reserve(std::size_t jobs, std::size_t contacts);
  /// Makes room for pairs of objects of that mesh.
  void reserve_for(const IndexedMesh& mesh);
  /// Of what is here, and of what the fronts in the pairs' memories have grown by.
  [[nodiscard]] std::size_t byte_count() const;
  /// Of the workers.
  [[nodiscard]] std::size_t thread_byte_count() const;

 private:
  /// Each worker's own, which only it touches while jobs run.
  struct Worker {
    PairDetector detector;
    PairCounters counters;
    PairAnswer answer;                ///< of the job at hand
    std::deque<PairAnswer> too_long;  ///< of this step, not expected to be so and not to be copied
    /// That fronts have grown by since the scene began. Only the sum over all workers means something: one
    /// may shrink a front that another has made grow.
    std::size_t front_bytes = 0;

    void reserve_as(const Worker& other);
    void reserve(const PairRoom& room);
  };
  struct LargeJob {
    std::uint32_t job = 0;
    LargePair pair;
    bool answered = false;
    std::size_t front_bytes = 0;  ///< when it began
  };
  /// A slice of a large pair.
  struct LargeSlice {
    std::uint32_t large;  ///< into large_
    std::uint32_t slice;
  };

  [[nodiscard]] PairQuery query_of(const PairJob& job) const;
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
  void keep_time_back(std::size_t last_contacts, ReportBuilder& report);
  void share_contacts(const FrameReport& previous);
  [[nodiscard]] bool make_room_in_report(std::size_t contacts);
  [[nodiscard]] Clock::time_point deadline_now() const;
  bool owes_capacity_ = false;  ///< the last step had no time to even out memory
  [[nodiscard]] bool is_late() const;
  void sort_by_urgency();
  void run_by_urgency();
  void run_within_work(std::uint64_t budget);

  const SceneSettings& settings_;
  TaskPool& tasks_;
  std::span<const PairJob> jobs_;
  std::size_t pair_count_ = 0;  ///< of all pairs, those that rest included
  std::uint64_t rules_version_ = 0;
  Clock::time_point deadline_ = PairQuery::no_deadline;  ///< for all but the contacts that are found
  std::atomic<std::size_t> contacts_found_{0};           ///< where there is a deadline
  std::vector<Contact>* lent_ = nullptr;                 ///< the report's, for the answer of a job
  std::uint32_t lent_to_ = 0;                            ///< that job
  NearestContacts nearest_;                              ///< of all jobs, where contacts are limited
  std::mutex report_mutex_;
  ReportBuilder* report_ = nullptr;     ///< where there is a deadline; `report_mutex_` guards it
  std::size_t contacts_with_room_ = 0;  ///< in it; likewise
  PairAnswers answers_;
  std::vector<std::uint32_t> order_;       ///< jobs that are looked at, by urgency where there is a budget
  std::vector<std::uint32_t> small_jobs_;  ///< of one group
  std::vector<LargeJob> large_;            ///< likewise; kept longer for their memory
  std::size_t large_count_ = 0;
  std::vector<PairAnswer> large_answers_;  ///< of all groups, one after the other; kept longer likewise
  std::size_t large_answer_count_ = 0;     ///< of the groups before
  std::vector<std::uint32_t> long_jobs_;   ///< small ones whose lists were long in the last step, ascending
  std::vector<PairAnswer> long_answers_;   ///< of these; kept longer likewise
  std::vector<LargeSlice> slices_;         ///< of all large jobs of the group
  std::vector<Worker> workers_;
  PairRoom room_;  ///< what was reserved of the workers' memory
};

}  // namespace graze
