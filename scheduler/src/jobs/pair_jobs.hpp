#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/contact_limit.hpp"
#include "base/task_pool.hpp"
#include "core/pair/pair_counters.hpp"
#include "jobs/job_work.hpp"
#include "jobs/job_workers.hpp"
#include "jobs/large_pairs.hpp"
#include "jobs/last_contacts.hpp"
#include "jobs/pair_answers.hpp"
#include "jobs/pair_queries.hpp"
#include "jobs/step_deadline.hpp"
#include "pairs/pair_job.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// Runs a step's jobs on the task pool: DMV, DV and contact determination. Stepping thread only.
///
/// It decides in which order jobs run and which of them make a task. Each part of it answers one other
/// question. PairQueries says what is asked of a pair. StepDeadline says how long jobs may run. LargePairs
/// lets several workers search one pair. PairAnswers says what becomes of an answer. JobWorkers owns the
/// memory of each worker. JobWork estimates how long the jobs take.
class PairJobs {
 public:
  PairJobs(const SceneSettings& settings, TaskPool& tasks);

  /// Answers every job that tests its pair. Budgets of time began at `start`. Contacts will be written into
  /// `report`.
  void run(const PairList& list, std::uint64_t rules_version, StepDeadline::Clock::time_point start,
           const LastContacts& last, ReportBuilder& report);

  /// The answers of the jobs, valid until `equalize_capacity`.
  [[nodiscard]] const PairAnswers& answers() const { return answers_; }
  /// The longest list of contacts, if it is better adopted by the report than copied. Otherwise it is null.
  [[nodiscard]] std::vector<Contact>* longest_list() { return answers_.longest_list(large_.answers()); }
  [[nodiscard]] PairCounters counters() const { return workers_.counters(); }

  /// Gives all workers the capacity that any of them needed, so that a step like the last one allocates
  /// nothing. Discards the answers. Returns false if the time budget ended before all was done. The next step
  /// then keeps time back for it.
  [[nodiscard]] bool equalize_capacity();
  /// Reserves memory for that many jobs, and for the contacts of all of them together.
  void reserve(std::size_t jobs, std::size_t contacts);
  /// Reserves memory for pairs with objects of that mesh, which may be solids.
  void reserve_for(const IndexedMesh& mesh, bool is_solid) { workers_.reserve_for(mesh, is_solid); }
  /// The bytes held here, and the growth of the fronts in the pairs' memories.
  [[nodiscard]] std::size_t byte_count() const;
  /// The bytes held by the workers.
  [[nodiscard]] std::size_t thread_byte_count() const { return workers_.byte_count(); }

 private:
  void list_tested();
  [[nodiscard]] std::size_t repeated_contacts(const LastContacts& last) const;
  void sort_by_urgency();
  void run_by_urgency();
  void run_within_work(std::uint64_t budget);
  [[nodiscard]] bool is_long(const PairJob& job) const;
  void list_group(std::span<const std::uint32_t> jobs);
  void run_group(std::span<const std::uint32_t> jobs);
  void detect(std::uint32_t index, unsigned worker, std::uint64_t work_limit);

  const SceneSettings& settings_;
  TaskPool& tasks_;
  const ContactLimit limit_;
  StepDeadline deadline_;
  PairQueries queries_;
  JobWorkers workers_;
  JobWork work_;
  PairAnswers answers_;
  LargePairs large_;
  std::span<const PairJob> jobs_;
  std::vector<std::uint32_t> order_;       ///< jobs that test their pairs; by urgency if there is a budget
  std::vector<std::uint32_t> small_jobs_;  ///< the small jobs of the current group, but for the long ones
  std::vector<std::uint32_t> long_jobs_;   ///< those that took long in the last step, the longest first
};

}  // namespace graze
