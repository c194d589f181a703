#pragma once

#include <chrono>
#include <cstdint>
#include <graze/large_pair.hpp>
#include <graze/pair_query.hpp>
#include <span>
#include <vector>

#include "pair_job.hpp"
#include "task_pool.hpp"

namespace graze {

/// Runs a step's jobs on the task pool: refits what they need, then DMV, DV and contact determination.
/// Stepping thread only.
class PairJobs {
 public:
  using Clock = std::chrono::steady_clock;

  PairJobs(const SceneSettings& settings, TaskPool& tasks);

  /// Brings the regions of every object that `jobs` look at up to date.
  void refit(std::span<const PairJob> jobs);
  /// Answers every job that is looked at; budgets began at `start`.
  void run(std::span<const PairJob> jobs, std::uint64_t rules_version, Clock::time_point start);

  /// Of the job at that place; until the next `run`.
  [[nodiscard]] const PairAnswer& answer(std::size_t index) const { return answers_[index]; }
  [[nodiscard]] PairCounters counters() const;

 private:
  /// A slice of a large pair.
  struct LargeSlice {
    std::uint32_t large;  ///< into large_jobs_
    std::uint32_t slice;
  };

  [[nodiscard]] PairQuery query_of(const PairJob& job) const;
  [[nodiscard]] static bool is_large(const PairJob& job);
  void run_group(std::span<const std::uint32_t> jobs);
  void run_rounds_of_slices();
  void even_out_memory();
  void begin_large(std::uint32_t place, unsigned worker);
  void detect(std::uint32_t index, unsigned worker, std::uint64_t work_limit);
  [[nodiscard]] PairAnswer& answer_to_write(std::uint32_t index);
  void was_detected(std::uint32_t index);
  [[nodiscard]] bool is_late() const;
  void sort_by_urgency();
  void run_by_urgency();
  void run_within_work(std::uint64_t budget);

  const SceneSettings& settings_;
  TaskPool& tasks_;
  std::span<const PairJob> jobs_;
  std::uint64_t rules_version_ = 0;
  Clock::time_point deadline_ = PairQuery::no_deadline;
  std::vector<PairAnswer> answers_;        ///< one for each job; kept longer for their memory
  std::vector<std::uint32_t> order_;       ///< jobs that are looked at, by urgency where there is a budget
  std::vector<std::uint32_t> small_jobs_;  ///< of one group
  std::vector<std::uint32_t> large_jobs_;  ///< likewise
  std::vector<LargePair> large_;           ///< one for each large job; kept longer for their memory
  std::vector<std::uint8_t> answered_;     ///< likewise: whether it is
  std::vector<LargeSlice> slices_;         ///< of all large jobs of the group
  std::vector<Object*> to_refit_;
  std::vector<PairDetector> detectors_;  ///< one for each worker
  std::vector<PairCounters> counters_;   ///< likewise
};

}  // namespace graze
