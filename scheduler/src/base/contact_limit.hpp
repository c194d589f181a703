#pragma once

#include <algorithm>
#include <cstddef>
#include <graze/settings.hpp>
#include <optional>

#include "core/pair/carrying.hpp"

namespace graze {

/// Says how many contacts a scene lists of a pair and of a step. It is the one place that asks
/// SceneSettings::max_contacts, SceneSettings::max_contacts_per_pair and SceneSettings::carrying. A limit of
/// 0 is none.
class ContactLimit {
 public:
  explicit ContactLimit(const SceneSettings& settings)
      : chooses_carrying_(settings.carrying > 0 && settings.detail == ContactDetail::nearest),
        of_step_(settings.max_contacts.value_or(0)),
        of_search_(chooses_carrying_ ? 0 : lower_of(of_step_, settings.max_contacts_per_pair.value_or(0))),
        of_impacts_(lower_of(of_step_, settings.max_contacts_per_pair.value_or(0))),
        carrying_(lower_of(settings.carrying, settings.max_contacts_per_pair.value_or(0))),
        cuts_carrying_(carrying_ < settings.carrying),
        band_(settings.carrying_band) {}

  /// The most contacts of all pairs of a step together.
  [[nodiscard]] std::size_t of_step() const { return of_step_; }
  /// Whether the pairs of a step share its contacts. Then a pair knows its own only when all pairs have been
  /// answered.
  [[nodiscard]] bool is_shared() const { return of_step_ > 0; }
  /// How many of `wanted` further contacts a step can list that has `listed` already.
  [[nodiscard]] std::size_t of_further(std::size_t wanted, std::size_t listed) const {
    return is_shared() ? std::min(wanted, of_step_ - std::min(of_step_, listed)) : wanted;
  }

  /// The most contacts that the search of a pair keeps. There is no limit if those that carry are chosen,
  /// since these are chosen out of all.
  [[nodiscard]] std::size_t of_search() const { return of_search_; }

  /// The most impacts that a sweep of a pair keeps.
  [[nodiscard]] std::size_t of_impacts() const { return of_impacts_; }

  /// Whether only those contacts are listed that carry their pair.
  [[nodiscard]] bool chooses_carrying() const { return chooses_carrying_; }
  /// How these are chosen in a pair with this threshold.
  [[nodiscard]] CarryingRule carrying_rule(double threshold) const {
    return {carrying_, band_.value_or(threshold)};
  }
  /// Whether a pair may list less of them than SceneSettings::carrying asks for.
  [[nodiscard]] bool cuts_carrying() const { return cuts_carrying_; }

 private:
  static std::size_t lower_of(std::size_t left, std::size_t right) {
    return left == 0 || right == 0 ? std::max(left, right) : std::min(left, right);
  }

  bool chooses_carrying_;
  std::size_t of_step_;
  std::size_t of_search_;
  std::size_t of_impacts_;
  std::size_t carrying_;
  bool cuts_carrying_;
  std::optional<double> band_;
};

}  // namespace graze
