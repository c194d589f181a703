#pragma once

#include <atomic>
#include <exception>
#include <graze/error.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <utility>

#include "base/settings_check.hpp"
#include "base/wait_while.hpp"
#include "calls/staging.hpp"
#include "report/report_pool.hpp"
#include "step/stepper.hpp"

namespace graze {

/// Says whether a step runs. The step shares it, since the scene may be destroyed before the step has cleared
/// it.
using Stepping = std::shared_ptr<std::atomic<bool>>;

/// The parts of a scene.
class Scene::State {
 public:
  State(const SceneSettings& given, std::shared_ptr<TaskScheduler> scheduler)
      : settings(checked(given)),
        reports(ReportPool::create()),
        stepper(settings, std::move(scheduler), staging, *reports) {}
  ~State() { wait_while(*stepping, true); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

 private:
  /// The pool deletes itself when its scene and all handles are gone.
  struct PoolCloser {
    void operator()(ReportPool* pool) const { pool->close(); }
  };
  static const SceneSettings& checked(const SceneSettings& settings) {
    if (const auto problem = problem_of(settings)) throw Error(*problem);
    return settings;
  }

 public:
  const SceneSettings settings;
  Staging staging;
  const std::unique_ptr<ReportPool, PoolCloser> reports;
  Stepper stepper;  ///< goes before `staging`, to which its objects give buffers back
  const Stepping stepping = std::make_shared<std::atomic<bool>>(false);
  std::exception_ptr problem;  ///< of the last step_async
};

}  // namespace graze
