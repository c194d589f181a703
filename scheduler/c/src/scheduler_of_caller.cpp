#include "scheduler_of_caller.hpp"

#include <stdexcept>
#include <utility>

#include "calls.hpp"
#include "settings.hpp"

namespace graze::c {
namespace {

class SchedulerOfCaller : public TaskScheduler {
 public:
  explicit SchedulerOfCaller(const graze_task_scheduler& functions) : functions_(functions) {}
  SchedulerOfCaller(const SchedulerOfCaller&) = delete;
  SchedulerOfCaller& operator=(const SchedulerOfCaller&) = delete;
  ~SchedulerOfCaller() override {
    if (functions_.release != nullptr) functions_.release(functions_.context);
  }

  void run(unsigned count, const std::function<void(unsigned)>& task) override {
    functions_.run(
        functions_.context, count,
        [](void* data, std::uint32_t index) {
          (*static_cast<const std::function<void(unsigned)>*>(data))(index);
        },
        const_cast<std::function<void(unsigned)>*>(&task));  // only its const call is used
  }

  void start(std::function<void()> work) override {
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

 private:
  graze_task_scheduler functions_;
};

}  // namespace

std::shared_ptr<TaskScheduler> scheduler_of_caller(const graze_task_scheduler* functions) {
  if (functions == nullptr) return nullptr;
  const graze_task_scheduler read = whole(*functions, graze_task_scheduler{}, "scheduler");
  if (read.run == nullptr || read.start == nullptr)
    throw BadArgument("scheduler has no function run, or no function start");
  return std::make_shared<SchedulerOfCaller>(read);
}

}  // namespace graze::c
