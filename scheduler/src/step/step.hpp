#pragma once

#include <chrono>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "calls/staging.hpp"
#include "jobs/last_contacts.hpp"
#include "jobs/pair_jobs.hpp"
#include "jobs/region_refit.hpp"
#include "pairs/pair_table.hpp"
#include "recording/frame_capture.hpp"
#include "report/contact_rows.hpp"
#include "report/report_builder.hpp"
#include "report/report_pool.hpp"
#include "step/scene_content.hpp"

namespace graze {

/// Does the work of a step, and holds what is remembered from step to step. Stepping thread only.
class Step {
 public:
  Step(const SceneSettings& settings, SceneContent& content, Staging& staging, ReportPool& reports);

  /// Fills `report`, the last one that the pool has begun, which follows `previous`. If it throws, neither
  /// the report nor this object can be used again. `capture` sees what is taken up, unless it is null.
  void run(const FrameReport& previous, FrameReport& report, FrameCapture* capture);
  /// Reserves memory ahead of time, unless all numbers are 0.
  void reserve(const SceneCapacity& capacity);

 private:
  using Clock = std::chrono::steady_clock;

  void apply_calls(std::vector<Diagnostic>& diagnostics, FrameCapture* capture);
  void set_ignored(const IgnoreGroups& groups);
  void reserve_for_pairs(const SceneCapacity& capacity);
  void prepare_surface(Surface& surface, const ObjectSettings& settings);
  void prepare_copy(Object& object);
  void write_pairs(const PairList& list, const FrameReport& previous, ReportBuilder& builder);
  void write_pair(const PairJob& job, std::size_t index, const FrameReport& previous, ReportBuilder& builder);
  void end_pair(PairReport row, ReportBuilder& builder);
  void repeat_pairs(const LastRows& resting, const FrameReport& previous, ReportBuilder& builder);
  void repeat_rows(const FrameReport& previous, StepStatistics& statistics);
  void equalize_capacity(Clock::time_point start);
  void sum_counters(StepStatistics& statistics);
  void count_bytes_of_pairs(std::span<const PairJob> jobs, StepStatistics& statistics);

  const SceneSettings& settings_;
  SceneContent& content_;
  Staging& staging_;
  ReportPool& reports_;
  TaskPool& tasks_;
  ObjectStore& store_;
  PairTable pairs_;
  RegionRefit refit_;
  PairJobs jobs_;
  LastContacts last_contacts_;
  ContactRows contacts_;
  bool is_reserved_ = false;    ///< near pairs have reserved room, also those of later objects
  std::size_t rows_again_ = 0;  ///< rows of the current report that are unchanged from the last
  /// The last step tested no pair and all its rows were repeated. If nothing changes, the next step can
  /// repeat its report.
  bool can_repeat_report_ = false;
};

}  // namespace graze
