#pragma once

#include <cstdint>
#include <functional>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <vector>

#include "calls/staging.hpp"
#include "recording/frame_capture.hpp"
#include "report/report_pool.hpp"
#include "step/scene_content.hpp"
#include "step/step.hpp"

namespace graze {

/// Runs the steps of a scene, one after the other. Stepping thread only.
///
/// A step that throws leaves the last report published and the scene's content whole, wherever it throws. The
/// calls that it has applied stay applied. The other calls and its diagnostics wait for the next step. All
/// that steps remember of pairs and bounds is freed at once. The next step builds it again from the objects'
/// positions and the published report.
class Stepper {
 public:
  Stepper(const SceneSettings& settings, std::shared_ptr<TaskScheduler> scheduler, Staging& staging,
          ReportPool& reports);

  /// Whether no recorder sees the steps, or only one that can write no more.
  [[nodiscard]] bool can_attach() const {
    return capture_ == nullptr || capture_->is_closed() || capture_->has_given_up();
  }
  /// Lets a recorder see the steps from the next one on, until it is closed.
  void attach(std::shared_ptr<FrameCapture> capture) { capture_ = std::move(capture); }

  /// Lets a source bring ghosts, which are objects into all steps from the next one on. It stays, unless it
  /// is null.
  void take_ghosts_from(GhostSource* ghosts) { ghosts_ = ghosts; }
  /// Lets the next step go on from another report of the last frame, as if it had been published.
  void go_on_from(std::unique_ptr<const FrameReport> report) { other_previous_ = std::move(report); }
  /// What steps do not change but by calls.
  [[nodiscard]] SceneContent& content() { return content_; }

  /// Collects the calls made so far for the next `run`.
  void collect_calls() { staging_.collect(); }
  /// Fills and publishes the next report, with the caller's tag.
  ReportHandle run(std::uint64_t tag);
  /// Starts `work` on another thread, after `collect_calls`. `work` calls `run` and must not throw.
  void start(std::function<void()> work);

 private:
  [[nodiscard]] std::unique_ptr<Step> begun_afresh();
  void step_failed() noexcept;
  void fill(FrameReport& report, std::uint64_t tag);

  const SceneSettings& settings_;
  Staging& staging_;
  ReportPool& reports_;
  SceneContent content_;
  std::shared_ptr<FrameCapture> capture_;  ///< null where nobody records
  GhostSource* ghosts_ = nullptr;          ///< null where all objects are this process's
  std::unique_ptr<const FrameReport> other_previous_;
  std::unique_ptr<Step> step_;      ///< null after a failed step
  std::vector<Diagnostic> untold_;  ///< diagnostics of a failed step, not reported yet
};

}  // namespace graze
