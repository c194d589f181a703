#pragma once

#include <chrono>
#include <cstdint>
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
  [[nodiscard]] PairQuery query_of(const PairJob& job) const;
  void detect(std::size_t index, unsigned worker, std::uint64_t work_limit, Clock::time_point deadline);
  void sort_by_urgency();
  void run_within_work(std::uint64_t budget, Clock::time_point deadline);

  const SceneSettings& settings_;
  TaskPool& tasks_;
  std::span<const PairJob> jobs_;
  std::uint64_t rules_version_ = 0;
  std::vector<PairAnswer> answers_;    ///< one for each job; kept longer for their memory
  std::vector<std::uint32_t> urgent_;  ///< jobs by urgency
  std::vector<Object*> to_refit_;
  std::vector<PairDetector> detectors_;  ///< one for each worker
  std::vector<PairCounters> counters_;   ///< likewise
};

}  // namespace graze
