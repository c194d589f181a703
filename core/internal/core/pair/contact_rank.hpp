#pragma once

#include <graze/contact.hpp>
#include <limits>
#include <tuple>

namespace graze {

/// The order of contacts in an answer. It also identifies a contact of a pair.
inline auto contact_order(const Contact& contact) {
  return std::tie(contact.kind, contact.feature_a, contact.feature_b);
}

/// Whether an edge pierces a face. Such a contact says nothing of depth.
inline bool is_piercing(const Contact& contact) {
  return contact.kind == ContactKind::EF && contact.distance == 0;
}

/// By what contacts are kept where a limit leaves some out: the lowest come first, and equal ones by kind and
/// features. It is the distance, or with ContactDetail::nearest the separation, so that the deepest come
/// first. Edges that pierce come last there.
inline double contact_rank(ContactDetail detail, const Contact& contact) {
  if (detail != ContactDetail::nearest) return contact.distance;
  return is_piercing(contact) ? std::numeric_limits<double>::infinity() : contact.separation();
}

}  // namespace graze
