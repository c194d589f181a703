#pragma once

#include <chrono>
#include <graze/report.hpp>
#include <span>
#include <vector>

#include "calls/staging.hpp"
#include "geometry/geometry_keeper.hpp"
#include "geometry/mesh_keeper.hpp"
#include "jobs/last_contacts.hpp"
#include "jobs/pair_jobs.hpp"
#include "jobs/pair_sweeps.hpp"
#include "jobs/region_refit.hpp"
#include "pairs/pair_table.hpp"
#include "patches/patch_keeper.hpp"
#include "recording/frame_capture.hpp"
#include "report/report_builder.hpp"
#include "report/report_pool.hpp"
#include "step/ghost_source.hpp"
#include "step/row_writer.hpp"
#include "step/scene_content.hpp"
#include "step/step_reserve.hpp"

namespace graze {

/// Does the work of a step, and holds what is remembered from step to step. Stepping thread only.
class Step {
 public:
  Step(const SceneSettings& settings, SceneContent& content, Staging& staging, ReportPool& reports);

  /// Fills `report`, the last one that the pool has begun, which follows `previous`. If it throws, neither
  /// the report nor this object can be used again. `capture` sees what is taken up, and `ghosts` brings more
  /// objects, unless they are null.
  void run(const FrameReport& previous, FrameReport& report, FrameCapture* capture, GhostSource* ghosts);
  /// Lets the next step look its pairs up in the report that it is given, which has other rows than the last.
  void expect_other_rows() {
    pairs_.forget_rows();
    can_repeat_report_ = false;
  }
  /// Reserves memory ahead of time, unless all numbers are 0.
  void reserve(const SceneCapacity& capacity) { reserve_.reserve(capacity); }

 private:
  using Clock = std::chrono::steady_clock;

  void apply_calls(std::vector<Diagnostic>& diagnostics, FrameCapture* capture);
  void sweep(PairList& list, Clock::time_point start, StepStatistics& statistics);
  void repeat_rows(const FrameReport& previous, StepStatistics& statistics);
  void equalize_capacity();
  void sum_counters(StepStatistics& statistics);
  void count_bytes_of_pairs(StepStatistics& statistics);

  Staging& staging_;
  ReportPool& reports_;
  TaskPool& tasks_;
  ObjectStore& store_;
  PairTable pairs_;
  RegionRefit refit_;
  PairSweeps sweeps_;
  PairJobs jobs_;
  LastContacts last_contacts_;
  RowWriter rows_;
  StepReserve reserve_;
  GeometryKeeper geometry_;
  MeshKeeper meshes_;
  PatchKeeper patches_;
  /// The last step tested no pair and all its rows were repeated. If nothing changes, the next step can
  /// repeat its report.
  bool can_repeat_report_ = false;
};

}  // namespace graze
