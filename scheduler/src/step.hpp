#pragma once

#include <chrono>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "contact_rows.hpp"
#include "object_store.hpp"
#include "pair_jobs.hpp"
#include "pair_table.hpp"
#include "region_refit.hpp"
#include "report_builder.hpp"
#include "report_pool.hpp"
#include "staging.hpp"
#include "task_pool.hpp"

namespace graze {

/// What one step does, and what is kept from step to step. Stepping thread only.
class Step {
 public:
  Step(const SceneSettings& settings, Staging& staging, ReportPool& reports);

  /// Takes the calls made so far for the next `run`.
  void take_calls() { staging_.take(); }
  /// Fills `report`, the last that the reports' pool has begun, with frame `frame`, which follows `previous`.
  void run(std::uint64_t frame, const FrameReport& previous, FrameReport& report);

  [[nodiscard]] TaskPool& tasks() { return tasks_; }

 private:
  using Clock = std::chrono::steady_clock;

  void take_up_calls(std::vector<Diagnostic>& diagnostics);
  void reserve(const SceneCapacity& capacity);
  void make_ready(Surface& surface);
  void write_pairs(const PairList& list, const FrameReport& previous, ReportBuilder& builder);
  void write_pair(const PairJob& job, std::size_t index, const FrameReport& previous, ReportBuilder& builder);
  void repeat_pairs(const RestingRows& resting, const FrameReport& previous, ReportBuilder& builder);
  void repeat_rows(const FrameReport& previous, StepStatistics& statistics);
  void sum_counters(StepStatistics& statistics);
  void count_bytes_of_pairs(std::span<const PairJob> jobs, StepStatistics& statistics);

  const SceneSettings& settings_;
  Staging& staging_;
  ReportPool& reports_;
  TaskPool tasks_;
  ObjectStore store_;
  PairTable pairs_;
  RegionRefit refit_;
  PairJobs jobs_;
  ContactRows contacts_;
  bool is_reserved_ = false;    ///< room for near pairs, also of objects that come
  std::size_t rows_again_ = 0;  ///< of the report being written, as they were in the last
  /// The last step looked at no pair and all its rows were as before: so will be the next one's if nothing
  /// changes.
  bool is_settled_ = false;
};

}  // namespace graze
