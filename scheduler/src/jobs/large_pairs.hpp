#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "core/pair/group_filter.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"
#include "core/search/large_pair.hpp"
#include "jobs/job_workers.hpp"
#include "jobs/pair_answers.hpp"
#include "jobs/pair_queries.hpp"
#include "jobs/step_deadline.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// The large pairs of a group of jobs. Each is searched in stages that are cut into slices, and all workers
/// run the slices of all pairs of the group:
///
///     large.begin_group();
///     for (each large job of the group) large.add(index, job);
///     for (i in 0 … large.count() - 1) large.begin(i, worker);  // at once, in any order
///     large.run_slices();
///
/// The stepping thread uses it, but for `begin`. A task of `begin` or of an advance writes its own pair, and
/// a slice writes a record of its own. Slices and advances are different rounds of TaskPool::run, which waits
/// for all tasks: so what one round has written is only read in the next.
class LargePairs {
 public:
  LargePairs(TaskPool& tasks, const PairQueries& queries, const StepDeadline& deadline, PairAnswers& answers,
             JobWorkers& workers);

  /// Begins a step. Answers of the last one are overwritten.
  void begin_step();
  /// Begins a group of jobs. Answers of earlier groups of the step stay.
  void begin_group();
  /// Adds a job of the group, before any of them begins.
  void add(std::uint32_t index, const PairJob& job);
  /// The number of large pairs in the group.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Begins the search of a pair, up to its first slices. Any thread may call this for different pairs.
  void begin(std::size_t index, unsigned worker);
  /// Runs the slices of all pairs as one list, round after round, until every pair is answered.
  void run_slices();

  /// The answers of all large pairs of the step, which stay until the next.
  [[nodiscard]] std::span<PairAnswer> answers() {
    return std::span(answers_).first(answers_of_earlier_groups_ + count_);
  }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct LargeJob {
    std::uint32_t index = 0;  ///< of the job
    const PairJob* job = nullptr;
    PairQuery query;
    std::optional<FeatureFilter> filter;  ///< what the query refers to, where faces are hidden
    LargePair pair;
    bool is_answered = false;
    std::size_t front_bytes = 0;  ///< the bytes of the front when the job began
  };
  /// A slice of a large pair.
  struct Slice {
    std::uint32_t large;  ///< index into large_
    std::uint32_t slice;
  };

  [[nodiscard]] PairAnswer& answer_of(std::size_t index);
  void advance(std::size_t index, unsigned worker);
  void list_slices();

  TaskPool& tasks_;
  const PairQueries& queries_;
  const StepDeadline& deadline_;
  PairAnswers& kept_;
  JobWorkers& workers_;
  std::vector<LargeJob> large_;  ///< those of the current group. It never shrinks, to keep memory
  std::size_t count_ = 0;
  std::vector<PairAnswer> answers_;  ///< of all groups of the step. It never shrinks
  std::size_t answers_of_earlier_groups_ = 0;
  std::vector<Slice> slices_;  ///< of all pairs of the group
};

}  // namespace graze
