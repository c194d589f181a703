#pragma once

#include <cfenv>
#include <optional>

#include "core/base/compiler.hpp"

#if GRAZE_EXTENSIONS && defined(__SSE2_MATH__)
#include <xmmintrin.h>
#endif

namespace graze {

/// Rounding to nearest, no flushing of denormals and no traps while it lives. Afterwards it restores what the
/// caller had. Every task and every call that computes has one, so that results do not depend on what a
/// foreign library left behind.
class FloatingPointScope {
 public:
  FloatingPointScope() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatingPointScope() { std::fesetenv(&before_); }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  std::fenv_t before_{};
};

/// Whether the calling thread computes as in a FloatingPointScope already. It may say no where it does.
inline bool is_in_default_mode() {
#if GRAZE_EXTENSIONS && defined(__SSE2_MATH__)
  constexpr unsigned exception_flags = 0x3F;
  constexpr unsigned defaults = 0x1F80;
  return (_mm_getcsr() & ~exception_flags) == defaults;
#else
  return false;
#endif
}

/// A FloatingPointScope for calls that take less time than one. It leaves all as it is where the caller
/// computes in that mode already, and may leave exception flags behind then.
class BriefFloatingPointScope {
 public:
  BriefFloatingPointScope() {
    if (!is_in_default_mode()) [[unlikely]]
      scope_.emplace();
  }

 private:
  std::optional<FloatingPointScope> scope_;
};

}  // namespace graze
