#pragma once

#include <graze/graze.h>

#include <functional>
#include <graze/task_scheduler.hpp>
#include <memory>

namespace graze::c {

/// Calls the caller's functions.
class SchedulerOfCaller : public TaskScheduler {
 public:
  explicit SchedulerOfCaller(const graze_task_scheduler& functions) : functions_(functions) {}
  SchedulerOfCaller(const SchedulerOfCaller&) = delete;
  SchedulerOfCaller& operator=(const SchedulerOfCaller&) = delete;
  ~SchedulerOfCaller() override;

  void run(unsigned count, const std::function<void(unsigned)>& task) override;
  void start(std::function<void()> work) override;
  /// Says that a scene has the scheduler. Before, the caller's functions are the caller's to release.
  void take() { is_taken_ = true; }

 private:
  graze_task_scheduler functions_;
  bool is_taken_ = false;
};

/// Returns a scheduler that calls the caller's functions, or null for null.
[[nodiscard]] std::shared_ptr<SchedulerOfCaller> scheduler_of_caller(const graze_task_scheduler* functions);

}  // namespace graze::c
