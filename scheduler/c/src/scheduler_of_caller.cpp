#include "scheduler_of_caller.hpp"

#include <stdexcept>
#include <utility>

#include "calls.hpp"
#include "settings.hpp"

namespace graze::c {

SchedulerOfCaller::~SchedulerOfCaller() {
  if (is_taken_ && functions_.release != nullptr) functions_.release(functions_.context);
}

void SchedulerOfCaller::run(unsigned count, const std::function<void(unsigned)>& task) {
  functions_.run(
      functions_.context, count,
      [](void* data, std::uint32_t index) {
        (*static_cast<const std::function<void(unsigned)>*>(data))(index);
      },
      const_cast<std::function<void(unsigned)>*>(&task));  // only its const call is used
}

void SchedulerOfCaller::start(std::function<void()> work) {
  auto kept = std::make_unique<std::function<void()>>(std::move(work));
  const auto do_work = [](void* data) {
    const std::unique_ptr<std::function<void()>> mine(static_cast<std::function<void()>*>(data));
    (*mine)();
  };
  if (!functions_.start(functions_.context, do_work, kept.get()))
    throw std::runtime_error("the scheduler did not start the step");
  // The other thread frees it, perhaps already.
  static_cast<void>(kept.release());
}

std::shared_ptr<SchedulerOfCaller> scheduler_of_caller(const graze_task_scheduler* functions) {
  if (functions == nullptr) return nullptr;
  const graze_task_scheduler read = whole(*functions, graze_task_scheduler{}, "scheduler");
  if (read.run == nullptr || read.start == nullptr)
    throw BadArgument("scheduler has no function run, or no function start");
  return std::make_shared<SchedulerOfCaller>(read);
}

}  // namespace graze::c
