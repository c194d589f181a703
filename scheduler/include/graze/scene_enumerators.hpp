#pragma once

#include <graze/enumerators.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <string_view>

namespace graze {

// The enumerations of scenes, as enumerators.hpp has those of surfaces.

/// @addtogroup settings
/// @{

/// Returns the enumerator's own name, such as "rigid". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(Motion motion) {
  switch (motion) {
    case Motion::deformable:
      return "deformable";
    case Motion::rigid:
      return "rigid";
    case Motion::fixed:
      return "fixed";
  }
  return {};
}

/// Returns the enumerator's own name, such as "when_told". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(BindPolicy policy) {
  switch (policy) {
    case BindPolicy::every_step:
      return "every_step";
    case BindPolicy::when_told:
      return "when_told";
  }
  return {};
}

/// Returns the enumerator's own name, such as "own". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(ArenaPolicy policy) {
  switch (policy) {
    case ArenaPolicy::own:
      return "own";
    case ArenaPolicy::callers:
      return "callers";
  }
  return {};
}

/// @}

/// @addtogroup report
/// @{

/// Returns the enumerator's own name, such as "touching". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(PairPhase phase) {
  switch (phase) {
    case PairPhase::near:
      return "near";
    case PairPhase::began:
      return "began";
    case PairPhase::touching:
      return "touching";
    case PairPhase::ended:
      return "ended";
  }
  return {};
}

/// Returns the enumerator's own name, such as "stale_id". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(DiagnosticKind kind) {
  switch (kind) {
    case DiagnosticKind::stale_id:
      return "stale_id";
    case DiagnosticKind::wrong_count:
      return "wrong_count";
    case DiagnosticKind::null_memory:
      return "null_memory";
    case DiagnosticKind::misaligned_memory:
      return "misaligned_memory";
    case DiagnosticKind::wrong_motion:
      return "wrong_motion";
    case DiagnosticKind::bad_pose:
      return "bad_pose";
    case DiagnosticKind::not_finite:
      return "not_finite";
    case DiagnosticKind::too_large:
      return "too_large";
    case DiagnosticKind::broken_promise:
      return "broken_promise";
    case DiagnosticKind::bad_pair:
      return "bad_pair";
    case DiagnosticKind::bad_rule:
      return "bad_rule";
    case DiagnosticKind::out_of_memory:
      return "out_of_memory";
  }
  return {};
}

/// @}

}  // namespace graze
