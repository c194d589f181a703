#pragma once

#include <compare>
#include <cstdint>
#include <graze/contact.hpp>

namespace graze {

/// The sort key of contacts as two numbers.
struct ContactKey {
  std::uint64_t of_a, of_b;

  friend auto operator<=>(const ContactKey&, const ContactKey&) = default;
};

inline ContactKey key_of(const Contact& contact) {
  const auto number = [](const Feature& feature) {
    return std::uint64_t{static_cast<std::uint8_t>(feature.kind)} << 32U | feature.index;
  };
  return {std::uint64_t{static_cast<std::uint8_t>(contact.kind)} << 40U | number(contact.feature_a),
          number(contact.feature_b)};
}

}  // namespace graze
