#include <algorithm>

#include "support/oracle/oracle_distance.hpp"
#include "support/oracle/oracle_parallel.hpp"

namespace graze::oracle {

namespace {

/// The contacts of `features` at exactly this distance, whatever the threshold.
ExactContacts candidates_at(const ExactShape& a, const ExactShape& b, const Rational& distance_squared,
                            const FacePairs& pairs) {
  ExactContacts contacts = collect_features(a, b, Limit::up_to(distance_squared), pairs);
  std::erase_if(contacts,
                [&](const auto& entry) { return entry.second.distance_squared != distance_squared; });
  return contacts;
}

/// Whether a candidate is only an end or border of the closest set of another, parallel one.
bool gives_way(const Name& name, const ExactShape& a, const ExactShape& b, const ExactContacts& parallel) {
  return std::any_of(parallel.begin(), parallel.end(), [&](const auto& entry) {
    const Name& larger = entry.first;
    return name != larger && a.is_part(name.a, larger.a) && b.is_part(name.b, larger.b);
  });
}

}  // namespace

std::optional<Named> closest(const Shape& shape_a, const Shape& shape_b, double threshold,
                             const FacePairs& pairs) {
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  const Rational distance_squared = smallest_distance_squared(a, b, pairs);
  if (!Limit::below(threshold).admits(distance_squared)) {
    // A pair that touches is not below a threshold of 0. It is a contact only if one feature pierces the
    // other.
    if (!is_pierced(a, b, pairs)) return std::nullopt;
    for (const auto& [name, contact] : candidates_at(a, b, distance_squared, pairs))
      if (contact.pierced) return rounded(name, contact);
  }

  ExactContacts candidates = collect_parallel(a, b, distance_squared, pairs);
  const ExactContacts parallel = candidates;
  candidates.merge(candidates_at(a, b, distance_squared, pairs));
  for (const auto& [name, contact] : candidates)
    if (!gives_way(name, a, b, parallel)) return rounded(name, contact);
  return std::nullopt;
}

}  // namespace graze::oracle
