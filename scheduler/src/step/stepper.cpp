#include "step/stepper.hpp"

#include <utility>

#include "core/base/floating_point_scope.hpp"

namespace graze {

Stepper::Stepper(const SceneSettings& settings, std::shared_ptr<TaskScheduler> scheduler, Staging& staging,
                 ReportPool& reports)
    : settings_(settings),
      staging_(staging),
      reports_(reports),
      content_(settings, std::move(scheduler)),
      step_(begun_afresh()) {}

ReportHandle Stepper::run(std::uint64_t tag) {
  const FloatingPointScope scope;
  if (capture_ != nullptr && capture_->is_closed()) capture_.reset();
  try {
    if (step_ == nullptr) step_ = begun_afresh();
    fill(reports_.begin(), tag);
  } catch (...) {
    step_failed();
    throw;
  }
  ReportHandle report = reports_.publish();
  if (capture_ != nullptr) capture_->end_step(report);
  return report;
}

void Stepper::start(std::function<void()> work) {
  try {
    content_.tasks.start(std::move(work));
  } catch (...) {
    step_failed();
    throw;
  }
}

void Stepper::step_failed() noexcept {
  staging_.step_failed();
  content_.store.forget_promises();
}

/// Creates a step with the reserved capacity. If there is no memory for that capacity, the scene does without
/// it and does not try again.
std::unique_ptr<Step> Stepper::begun_afresh() {
  auto step = std::make_unique<Step>(settings_, content_, staging_, reports_);
  step->reserve(std::exchange(content_.reserved, {}));
  return step;
}

void Stepper::fill(FrameReport& report, std::uint64_t tag) {
  ReportBuilder builder(report);
  const ReportHandle latest = reports_.latest();
  const std::unique_ptr<const FrameReport> other = std::move(other_previous_);
  if (other != nullptr) step_->expect_other_rows();
  const FrameReport& previous = other != nullptr ? *other : *latest;
  builder.begin(previous.frame() + 1, tag);
  if (!untold_.empty()) builder.diagnostics().swap(untold_);
  try {
    step_->run(previous, report, capture_.get(), ghosts_);
  } catch (...) {
    untold_.swap(builder.diagnostics());
    step_.reset();
    content_.store.forget();
    reports_.cancel();
    throw;
  }
}

}  // namespace graze
