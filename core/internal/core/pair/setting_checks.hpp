#pragma once

#include <cmath>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/enumerators.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/number_text.hpp"
#include "core/pair/pair_query.hpp"

namespace graze {

/// Says in one sentence that a setting is no distance, or nothing if it is finite and not negative. `owner`
/// begins the sentence, such as "scene: ", and `name` is that of the setting.
inline std::optional<std::string> problem_of_distance(std::string_view owner, std::string_view name,
                                                      double value) {
  if (std::isfinite(value) && value >= 0) return std::nullopt;
  return std::string(owner) + std::string(name) + " is " + number_text(value) +
         "; give a distance that is finite and not negative";
}

/// Says in one sentence that a setting is no range, or nothing if it is not negative. A range may be
/// infinite. The comparison is a quiet one: NaN must not trap where the caller has traps enabled.
inline std::optional<std::string> problem_of_range(std::string_view owner, std::string_view name,
                                                   double value) {
  if (std::isgreaterequal(value, 0.0)) return std::nullopt;
  return std::string(owner) + std::string(name) + " is " + number_text(value) +
         "; give a distance that is not negative, or infinity";
}

/// Says in one sentence that a number was cast to an enumeration without being one of its enumerators.
template <NamedEnumeration Enumeration>
std::optional<std::string> problem_of_enumerator(std::string_view owner, std::string_view name,
                                                 Enumeration value) {
  if (!name_of(value).empty()) return std::nullopt;
  constexpr Enumeration last = enumerators<Enumeration>.back();
  return std::string(owner) + std::string(name) + " is " + std::to_string(static_cast<unsigned>(value)) +
         "; the last one is " + std::to_string(static_cast<unsigned>(last));
}

/// Says in one sentence that an accuracy does not go with a detail, or nothing if it does.
inline std::optional<std::string> problem_of_accuracy(std::string_view owner, const Accuracy& accuracy,
                                                      ContactDetail detail) {
  if (accuracy.mode() != AccuracyMode::paper || is_about_vertices(detail)) return std::nullopt;
  return std::string(owner) + "paper accuracy goes with the details `regions` and `vertices` only";
}

}  // namespace graze
