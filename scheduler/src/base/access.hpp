#pragma once

#include <cstdint>

namespace graze {

/// Data of a step that several threads touch.
enum class StepData : std::uint8_t {
  surfaces,  ///< positions and bounds of objects, by object
  pairs,     ///< what is remembered and answered of pairs, by job
};

/// The right of a task to one kind of data: none, read everything, write one item, or read and write
/// everything.
struct AccessRight {
  enum class Level : std::uint8_t { none, read, write_one, write };
  Level level = Level::none;
  const void* one = nullptr;

  static AccessRight read() { return {Level::read, nullptr}; }
  static AccessRight write(const void* one) { return {Level::write_one, one}; }
  static AccessRight everything() { return {Level::write, nullptr}; }
};

/// The rights that a task declares before it touches shared data.
struct AccessRights {
  AccessRight surfaces;
  AccessRight pairs;
};

/// Gives the running thread the declared rights until the scope ends. Builds with GRAZE_VALIDATE check them:
/// the accessors of shared data call `require_read` and `require_write`, which throw std::logic_error. So a
/// data race shows as an error even on one thread. A thread without a scope, such as the stepping thread, may
/// do anything. A task that declares nothing may do nothing (see TaskPool). Other builds check nothing.
#ifdef GRAZE_VALIDATE
class AccessScope {
 public:
  explicit AccessScope(const AccessRights& rights);
  ~AccessScope();
  AccessScope(const AccessScope&) = delete;
  AccessScope& operator=(const AccessScope&) = delete;

 private:
  AccessRights before_;
};
void require_read(StepData data, const void* one);
void require_write(StepData data, const void* one);
#else
class AccessScope {
 public:
  explicit AccessScope(const AccessRights& /*rights*/) {}
};
inline void require_read(StepData /*data*/, const void* /*one*/) {}
inline void require_write(StepData /*data*/, const void* /*one*/) {}
#endif

}  // namespace graze
