#pragma once

#include <algorithm>
#include <graze/contact.hpp>
#include <span>

namespace graze::tools {

/// Returns the contact with the smallest separation, the first of several, or null where there is none.
inline const Contact* deepest_contact(std::span<const Contact> contacts) {
  const auto found = std::ranges::min_element(contacts, {}, &Contact::separation);
  return found == contacts.end() ? nullptr : &*found;
}

}  // namespace graze::tools
