#pragma once

#include <cstdint>

namespace graze {

/// Data of a step that several threads touch.
enum class StepData : std::uint8_t {
  surfaces,  ///< positions and bounds of objects, by object
  pairs,     ///< what is remembered and answered of pairs, by job
};

/// What may be done with one kind of data: nothing, reading it all, writing one piece of it, anything.
struct AccessRight {
  enum class Level : std::uint8_t { none, read, write_one, write };
  Level level = Level::none;
  const void* one = nullptr;

  static AccessRight read() { return {Level::read, nullptr}; }
  static AccessRight write(const void* one) { return {Level::write_one, one}; }
  static AccessRight everything() { return {Level::write, nullptr}; }
};

/// What a task declares before it touches anything.
struct AccessRights {
  AccessRight surfaces;
  AccessRight pairs;
};

/// Builds with GRAZE_VALIDATE hold every task of a step to what it declared, so that a race is an error on
/// one thread as well: `AccessScope` gives the running thread rights until it goes, the accessors of shared
/// data ask for them and throw std::logic_error. A thread that never declared anything (the one that steps)
/// may do anything; a task that declares nothing may do nothing (see TaskPool). Other builds check nothing.
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
