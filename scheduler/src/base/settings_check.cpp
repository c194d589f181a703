#include "base/settings_check.hpp"

#include <algorithm>
#include <cmath>
#include <graze/scene_enumerators.hpp>

#include "core/base/number_text.hpp"
#include "core/pair/pair_query.hpp"

namespace graze {
namespace {

bool is_distance(double value) {
  return std::isfinite(value) && value >= 0;
}

/// A range may be infinite: then every pair is listed. The comparison is a quiet one: NaN must not trap where
/// the caller has traps enabled.
bool is_range(double value) {
  return std::isgreaterequal(value, 0.0);
}

std::string not_a_distance(const char* what, double value) {
  return std::string(what) + " is " + number_text(value) +
         "; give a distance that is finite and not negative";
}

std::string not_a_range(const char* what, double value) {
  return std::string(what) + " is " + number_text(value) +
         "; give a distance that is not negative, or infinity";
}

/// Says that a number was cast to an enumeration without being one of its enumerators.
template <NamedEnumeration Enumeration>
std::optional<std::string> not_an_enumerator(const char* what, Enumeration value) {
  if (!name_of(value).empty()) return std::nullopt;
  constexpr Enumeration last = enumerators<Enumeration>.back();
  return std::string(what) + " is " + std::to_string(static_cast<unsigned>(value)) + "; the last one is " +
         std::to_string(static_cast<unsigned>(last));
}

}  // namespace

std::optional<std::string> problem_of(const SceneSettings& settings) {
  if (auto problem = not_an_enumerator("scene: detail", settings.detail)) return problem;
  if (auto problem = not_an_enumerator("scene: arena", settings.arena)) return problem;
  if (!is_distance(settings.contact_distance))
    return not_a_distance("scene: contact_distance", settings.contact_distance);
  if (!is_range(settings.range)) return not_a_range("scene: range", settings.range);
  if (settings.accuracy.mode() == AccuracyMode::paper && !is_about_vertices(settings.detail))
    return "scene: paper accuracy goes with the details `regions` and `vertices` only";
  if (settings.time_budget && settings.time_budget->count() < 0) return "scene: time_budget is negative";
  if (settings.max_contacts == 0 || settings.max_contacts_per_pair == 0)
    return "scene: max_contacts and max_contacts_per_pair are at least 1; ContactDetail::none lists no "
           "contacts";
  if (settings.carrying_band && !is_distance(*settings.carrying_band))
    return not_a_distance("scene: carrying_band", *settings.carrying_band);
  return std::nullopt;
}

std::optional<std::string> problem_of(const ObjectSettings& settings) {
  const std::string object = "object '" + settings.name + "': ";
  if (auto problem = not_an_enumerator((object + "motion").c_str(), settings.motion)) return problem;
  if (!is_distance(settings.margin)) return not_a_distance((object + "margin").c_str(), settings.margin);
  if (settings.kind >= kind_count)
    return object + "kind is " + std::to_string(settings.kind) + "; kinds are 0 to 255";
  return std::nullopt;
}

std::optional<std::string> problem_of(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  const std::string kinds =
      "rule of kinds " + std::to_string(kind_a) + " and " + std::to_string(kind_b) + ": ";
  if (std::max(kind_a, kind_b) >= kind_count) return kinds + "kinds are 0 to 255";
  if (rule.contact_distance && !is_distance(*rule.contact_distance))
    return not_a_distance((kinds + "contact_distance").c_str(), *rule.contact_distance);
  if (rule.range && !is_range(*rule.range)) return not_a_range((kinds + "range").c_str(), *rule.range);
  for (const double epsilon : rule.epsilon)
    if (!is_distance(epsilon)) return not_a_distance((kinds + "an epsilon").c_str(), epsilon);
  return std::nullopt;
}

}  // namespace graze
