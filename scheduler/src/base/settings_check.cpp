#include "base/settings_check.hpp"

#include <algorithm>
#include <cmath>
#include <graze/scene_enumerators.hpp>

#include "core/pair/setting_checks.hpp"

namespace graze {

std::optional<std::string> problem_of(const SceneSettings& settings) {
  if (auto problem = problem_of_enumerator("scene: ", "detail", settings.detail)) return problem;
  if (auto problem = problem_of_enumerator("scene: ", "arena", settings.arena)) return problem;
  if (auto problem = problem_of_distance("scene: ", "contact_distance", settings.contact_distance))
    return problem;
  if (auto problem = problem_of_range("scene: ", "range", settings.range)) return problem;
  if (auto problem = problem_of_accuracy("scene: ", settings.accuracy, settings.detail)) return problem;
  if (settings.time_budget && settings.time_budget->count() < 0) return "scene: time_budget is negative";
  if (settings.max_contacts == 0 || settings.max_contacts_per_pair == 0)
    return "scene: max_contacts and max_contacts_per_pair are at least 1; ContactDetail::none lists no "
           "contacts";
  if (settings.carrying_band)
    if (auto problem = problem_of_distance("scene: ", "carrying_band", *settings.carrying_band))
      return problem;
  if (auto problem = problem_of_distance("scene: ", "swept_gap", settings.swept_gap)) return problem;
  // The comparisons are quiet ones: NaN must not trap where the caller has traps enabled.
  if (!std::isgreaterequal(settings.sweep_tolerance, 0x1p-52) ||
      std::isgreater(settings.sweep_tolerance, 1.0))
    return "scene: sweep_tolerance is " + number_text(settings.sweep_tolerance) +
           "; give a part of a step, at least 2^-52 and at most 1";
  return std::nullopt;
}

std::optional<std::string> problem_of(const ObjectSettings& settings) {
  const std::string object = "object '" + settings.name + "': ";
  if (auto problem = problem_of_enumerator(object, "motion", settings.motion)) return problem;
  if (auto problem = problem_of_distance(object, "margin", settings.margin)) return problem;
  if (settings.kind >= kind_count)
    return object + "kind is " + std::to_string(settings.kind) + "; kinds are 0 to 255";
  if (settings.self_rings > most_self_rings)
    return object + "self_rings is " + std::to_string(settings.self_rings) + "; it is at most " +
           std::to_string(most_self_rings);
  if (auto problem = problem_of_distance(object, "patch_radius", settings.patch_radius)) return problem;
  if (settings.patch_faces == 0) return object + "patch_faces is 0; a patch has at least 1";
  return std::nullopt;
}

std::optional<std::string> problem_of(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  const std::string kinds =
      "rule of kinds " + std::to_string(kind_a) + " and " + std::to_string(kind_b) + ": ";
  if (std::max(kind_a, kind_b) >= kind_count) return kinds + "kinds are 0 to 255";
  if (rule.contact_distance)
    if (auto problem = problem_of_distance(kinds, "contact_distance", *rule.contact_distance)) return problem;
  if (rule.range)
    if (auto problem = problem_of_range(kinds, "range", *rule.range)) return problem;
  for (const double epsilon : rule.epsilon)
    if (auto problem = problem_of_distance(kinds, "an epsilon", epsilon)) return problem;
  return std::nullopt;
}

}  // namespace graze
