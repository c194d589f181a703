#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/impact.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace graze {

/// @addtogroup report
/// @{

// Each name_of() is the one list of its enumeration. Everything else that needs all enumerators, or their
// names, is made from it: files, recordings, texts of the program and tests. A switch that lacks an
// enumerator is a warning of the compiler, and graze's own builds stop at warnings.

/// Returns the enumerator's own name, such as "features". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(ContactDetail detail) {
  switch (detail) {
    case ContactDetail::none:
      return "none";
    case ContactDetail::closest:
      return "closest";
    case ContactDetail::regions:
      return "regions";
    case ContactDetail::vertices:
      return "vertices";
    case ContactDetail::features:
      return "features";
    case ContactDetail::nearest:
      return "nearest";
  }
  return {};
}

/// Returns the enumerator's own name, such as "within". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(AccuracyMode mode) {
  switch (mode) {
    case AccuracyMode::exact:
      return "exact";
    case AccuracyMode::within:
      return "within";
    case AccuracyMode::paper:
      return "paper";
  }
  return {};
}

/// Returns the enumerator's own name, such as "a_in_b". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(Inside inside) {
  switch (inside) {
    case Inside::none:
      return "none";
    case Inside::a_in_b:
      return "a_in_b";
    case Inside::b_in_a:
      return "b_in_a";
    case Inside::crossing:
      return "crossing";
  }
  return {};
}

/// Returns the enumerator's own name, such as "VF". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(ContactKind kind) {
  switch (kind) {
    case ContactKind::VV:
      return "VV";
    case ContactKind::VE:
      return "VE";
    case ContactKind::VF:
      return "VF";
    case ContactKind::EE:
      return "EE";
    case ContactKind::EF:
      return "EF";
    case ContactKind::FF:
      return "FF";
  }
  return {};
}

/// Returns the enumerator's own name, such as "vertex". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::vertex:
      return "vertex";
    case FeatureKind::edge:
      return "edge";
    case FeatureKind::face:
      return "face";
  }
  return {};
}

/// Returns the enumerator's own name, such as "front". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(Side side) {
  switch (side) {
    case Side::none:
      return "none";
    case Side::front:
      return "front";
    case Side::back:
      return "back";
  }
  return {};
}

/// Returns the enumerator's own name, such as "certain". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(ImpactStatus status) {
  switch (status) {
    case ImpactStatus::certain:
      return "certain";
    case ImpactStatus::possible:
      return "possible";
    case ImpactStatus::at_start:
      return "at_start";
  }
  return {};
}

/// An enumeration that has a name_of() above, or in `graze/scene_enumerators.hpp`.
template <typename Enum>
concept NamedEnumeration = std::is_enum_v<Enum> && requires(Enum value) {
  { name_of(value) } -> std::same_as<std::string_view>;
};

/// Returns the enumerator's own name, such as "features". It is "unknown" for any other value.
template <NamedEnumeration Enum>
[[nodiscard]] constexpr std::string_view to_string(Enum value) {
  const std::string_view name = name_of(value);
  return name.empty() ? "unknown" : name;
}

/// @cond internal
/// Counts the enumerators, whose values are 0, 1, 2 and so on: it ends at the first value without a name.
template <typename Enum>
[[nodiscard]] constexpr std::size_t enumerator_count() {
  std::size_t count = 0;
  while (!name_of(static_cast<Enum>(count)).empty()) ++count;
  return count;
}

template <typename Enum>
[[nodiscard]] constexpr auto make_enumerators() {
  std::array<Enum, enumerator_count<Enum>()> all{};
  for (std::size_t value = 0; value < all.size(); ++value) all[value] = static_cast<Enum>(value);
  return all;
}
/// @endcond

/// All enumerators of an enumeration, in an array, by ascending value. Use it to offer a choice, or to test a
/// program with every detail: `graze::enumerators<graze::ContactDetail>`.
template <NamedEnumeration Enum>
inline constexpr auto enumerators = make_enumerators<Enum>();

/// Returns the enumerator with this name, such as ContactDetail::features for "features". Returns no value
/// for another name.
template <NamedEnumeration Enum>
[[nodiscard]] constexpr std::optional<Enum> enumerator_named(std::string_view name) {
  for (const Enum enumerator : enumerators<Enum>)
    if (name_of(enumerator) == name) return enumerator;
  return std::nullopt;
}

/// Returns the names of all enumerators as a sentence lists them, such as "deformable, rigid or fixed".
template <NamedEnumeration Enum>
[[nodiscard]] std::string listed_names() {
  std::string list;
  for (std::size_t i = 0; i < enumerators<Enum>.size(); ++i) {
    if (i > 0) list += i + 1 < enumerators<Enum>.size() ? ", " : " or ";
    list += name_of(enumerators<Enum>[i]);
  }
  return list;
}

/// @}

}  // namespace graze
