#pragma once

#include <cfenv>

namespace graze {

/// Rounding to nearest, no flushing of denormals and no traps while it lives; what the caller had is
/// restored. Every task and every call that computes has one, so that results do not depend on what a foreign
/// library left behind.
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

}  // namespace graze
