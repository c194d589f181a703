#pragma once

#include <cstdint>
#include <functional>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <vector>

#include "calls/staging.hpp"
#include "report/report_pool.hpp"
#include "step/scene_content.hpp"
#include "step/step.hpp"

namespace graze {

/// Takes the steps of a scene, one after the other. Stepping thread only.
///
/// A step that throws leaves the last report published and the scene's content whole, wherever it throws.
/// Calls that it has taken up are done. The others wait for the next step, as do its diagnostics. All that
/// steps remember of pairs and bounds is forgotten at once, with its memory. The next step makes it anew from
/// where the objects are and from the published report.
class Stepper {
 public:
  Stepper(const SceneSettings& settings, Staging& staging, ReportPool& reports);

  /// Takes the calls made so far for the next `run`.
  void collect_calls() { staging_.collect(); }
  /// Fills and publishes the report that follows the published one, with the caller's tag.
  ReportHandle run(std::uint64_t tag);
  /// Begins what calls `run`, after `collect_calls`, on another thread; it must not throw.
  void start(std::function<void()> work);

 private:
  [[nodiscard]] std::unique_ptr<Step> begun_afresh();
  void step_failed() noexcept;
  void fill(FrameReport& report, std::uint64_t tag);

  const SceneSettings& settings_;
  Staging& staging_;
  ReportPool& reports_;
  SceneContent content_;
  std::unique_ptr<Step> step_;      ///< null after a step that failed
  std::vector<Diagnostic> untold_;  ///< by a step that failed
};

}  // namespace graze
