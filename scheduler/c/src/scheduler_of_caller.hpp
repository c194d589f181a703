#pragma once

#include <graze/graze.h>

#include <graze/task_scheduler.hpp>
#include <memory>

namespace graze::c {

/// Returns a scheduler that calls the caller's functions, or null for null.
[[nodiscard]] std::shared_ptr<TaskScheduler> scheduler_of_caller(const graze_task_scheduler* functions);

}  // namespace graze::c
