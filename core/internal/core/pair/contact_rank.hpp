#pragma once

#include <graze/contact.hpp>
#include <limits>

namespace graze {

/// By what contacts are kept where a limit leaves some out: the lowest come first, and equal ones by kind and
/// features. It is the distance, or with ContactDetail::nearest the separation, so that the deepest come
/// first. Edges that pierce say nothing of depth there, and come last.
inline double contact_rank(ContactDetail detail, const Contact& contact) {
  if (detail != ContactDetail::nearest) return contact.distance;
  const bool pierces = contact.kind == ContactKind::EF && contact.distance == 0;
  return pierces ? std::numeric_limits<double>::infinity() : contact.separation();
}

}  // namespace graze
