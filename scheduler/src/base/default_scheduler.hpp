#pragma once

#include <graze/settings.hpp>
#include <graze/task_scheduler.hpp>
#include <memory>

namespace graze {

// What a scene without a scheduler of the caller's runs its tasks with: oneTBB, in tbb_scheduler.cpp. Without
// oneTBB (the option GRAZE_TBB) it is one thread, in serial_scheduler.cpp.

/// How many threads a scene uses that asks for one each processor, at least 1.
unsigned default_threads();

/// How many threads of `threads` the default scheduler can use.
unsigned usable_threads(unsigned threads);

/// A scheduler that uses up to `threads` threads, which is 1 or more.
std::shared_ptr<TaskScheduler> make_default_scheduler(unsigned threads, ArenaPolicy policy);

}  // namespace graze
