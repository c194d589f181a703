#pragma once

#include <functional>

namespace graze {

/// @addtogroup scene
/// @{

/// Runs the tasks of a scene's steps on threads of the caller's own, in place of oneTBB. Scene takes one, and
/// any number of scenes may share it. Answers do not depend on it.
///
/// @par Threads
/// Each call may come from any thread, also from one that runs work of start(). Calls of run() for two scenes
/// may come at the same time. A scheduler that waits for its threads when it goes must not go on one of them:
/// keep it until all its scenes are gone.
class TaskScheduler {
 public:
  /// Frees the scheduler.
  virtual ~TaskScheduler() = default;

  /// Calls `task(0)`, `task(1)` and so on, `count` calls in all, each once. Returns when all of them have
  /// returned. The calls may run at the same time or one after the other, in any order and on any thread.
  ///
  /// Tasks do not throw, and do not wait for each other. The calling thread should take a part of them, so
  /// that a step goes on while all other threads are busy. `count` is at most the number of threads that
  /// SceneSettings::threads means. If this throws, no task may be running any more, and none may be called
  /// later. The calling thread does what is left.
  virtual void run(unsigned count, const std::function<void(unsigned task)>& task) = 0;

  /// Calls `work` once, on another thread, without waiting for it. Scene::step_async() runs its step so.
  /// `work` does not throw. It calls run(). If this throws, Scene::step_async() throws it too, and `work`
  /// must not be called.
  ///
  /// A scheduler without threads may call `work` before it returns. Then step_async() returns after its step.
  virtual void start(std::function<void()> work) = 0;

 protected:
  /// For derived classes.
  TaskScheduler() = default;
  /// For derived classes.
  TaskScheduler(const TaskScheduler&) = default;
  /// For derived classes.
  TaskScheduler& operator=(const TaskScheduler&) = default;
};

/// @}

}  // namespace graze
