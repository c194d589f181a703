#pragma once

#include <concepts>
#include <cstddef>
#include <graze/settings.hpp>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace graze {

/// @addtogroup settings
/// @{

/// Names one member of a struct of settings. Programs that store, show or compare settings get all of them
/// from for_each_field().
template <auto pointer>
struct SettingsField {
  /// The member's own name, such as "contact_distance".
  std::string_view name;
  /// The member: `settings.*field.member` is its value.
  static constexpr auto member = pointer;
};

/// @cond internal
/// Becomes a value of any type, where only the type of an expression is asked for.
struct AnyValue {
  template <typename Type>
  operator Type() const;
};

/// Returns how many of `members` are `member`.
template <auto member, auto... members>
[[nodiscard]] constexpr std::size_t times_among() {
  return (std::size_t{0} + ... + (std::is_same_v<SettingsField<member>, SettingsField<members>> ? 1U : 0U));
}

/// Returns whether a list has every member of the struct once. Then a struct is made of as many values as the
/// list has fields, and of no more, and no field stands twice.
template <typename Struct, auto... members>
[[nodiscard]] constexpr bool has_every_member(const std::tuple<SettingsField<members>...>&) {
  return requires {
    Struct{std::conditional_t<true, AnyValue, SettingsField<members>>{}...};
  }
  &&!requires {
    Struct{std::conditional_t<true, AnyValue, SettingsField<members>>{}..., {}};
  }
  &&((times_among<members, members...>() == 1) && ...);
}

// The one list of the fields of each struct. Recordings, reports, scene files, pages and the program are made
// from it. Recordings have the fields in this order, so a new one stands at the end.

inline constexpr std::tuple object_settings_fields{
    SettingsField<&ObjectSettings::name>{"name"},
    SettingsField<&ObjectSettings::motion>{"motion"},
    SettingsField<&ObjectSettings::layer>{"layer"},
    SettingsField<&ObjectSettings::collides_with>{"collides_with"},
    SettingsField<&ObjectSettings::group>{"group"},
    SettingsField<&ObjectSettings::margin>{"margin"},
    SettingsField<&ObjectSettings::kind>{"kind"},
    SettingsField<&ObjectSettings::user_data>{"user_data"},
    SettingsField<&ObjectSettings::solid>{"solid"},
    SettingsField<&ObjectSettings::face_groups>{"face_groups"},
    SettingsField<&ObjectSettings::hidden_groups>{"hidden_groups"},
    SettingsField<&ObjectSettings::self>{"self"},
    SettingsField<&ObjectSettings::self_rings>{"self_rings"},
    SettingsField<&ObjectSettings::self_at_rest>{"self_at_rest"},
    SettingsField<&ObjectSettings::swept>{"swept"},
    SettingsField<&ObjectSettings::queries>{"queries"},
    SettingsField<&ObjectSettings::patch_radius>{"patch_radius"},
    SettingsField<&ObjectSettings::patch_faces>{"patch_faces"},
};
static_assert(has_every_member<ObjectSettings>(object_settings_fields),
              "name every field of ObjectSettings above");

inline constexpr std::tuple pair_rule_fields{
    SettingsField<&PairRule::contact_distance>{"contact_distance"},
    SettingsField<&PairRule::range>{"range"},
    SettingsField<&PairRule::epsilon>{"epsilon"},
};
static_assert(has_every_member<PairRule>(pair_rule_fields), "name every field of PairRule above");

inline constexpr std::tuple scene_capacity_fields{
    SettingsField<&SceneCapacity::objects>{"objects"},
    SettingsField<&SceneCapacity::calls_per_step>{"calls_per_step"},
    SettingsField<&SceneCapacity::near_pairs>{"near_pairs"},
    SettingsField<&SceneCapacity::contacts>{"contacts"},
    SettingsField<&SceneCapacity::reports>{"reports"},
    SettingsField<&SceneCapacity::impacts>{"impacts"},
};
static_assert(has_every_member<SceneCapacity>(scene_capacity_fields),
              "name every field of SceneCapacity above");

inline constexpr std::tuple scene_settings_fields{
    SettingsField<&SceneSettings::contact_distance>{"contact_distance"},
    SettingsField<&SceneSettings::range>{"range"},
    SettingsField<&SceneSettings::detail>{"detail"},
    SettingsField<&SceneSettings::accuracy>{"accuracy"},
    SettingsField<&SceneSettings::threads>{"threads"},
    SettingsField<&SceneSettings::arena>{"arena"},
    SettingsField<&SceneSettings::time_budget>{"time_budget"},
    SettingsField<&SceneSettings::work_budget>{"work_budget"},
    SettingsField<&SceneSettings::max_contacts>{"max_contacts"},
    SettingsField<&SceneSettings::max_contacts_per_pair>{"max_contacts_per_pair"},
    SettingsField<&SceneSettings::region_distances>{"region_distances"},
    SettingsField<&SceneSettings::ways_out>{"ways_out"},
    SettingsField<&SceneSettings::carrying>{"carrying"},
    SettingsField<&SceneSettings::carrying_band>{"carrying_band"},
    SettingsField<&SceneSettings::sweep_tolerance>{"sweep_tolerance"},
    SettingsField<&SceneSettings::swept_gap>{"swept_gap"},
};
static_assert(has_every_member<SceneSettings>(scene_settings_fields),
              "name every field of SceneSettings above");

template <typename Struct>
inline constexpr std::nullptr_t settings_fields = nullptr;  // a struct without a list
template <>
inline constexpr auto settings_fields<ObjectSettings> = object_settings_fields;
template <>
inline constexpr auto settings_fields<PairRule> = pair_rule_fields;
template <>
inline constexpr auto settings_fields<SceneCapacity> = scene_capacity_fields;
template <>
inline constexpr auto settings_fields<SceneSettings> = scene_settings_fields;
/// @endcond

/// A struct whose fields are listed: ObjectSettings, PairRule, SceneCapacity or SceneSettings.
template <typename Struct>
concept HasSettingsFields = !std::same_as<decltype(settings_fields<Struct>), const std::nullptr_t>;

/// Calls `visit` with the SettingsField of each member of Struct but those that are named, in a fixed order.
///
///     for_each_field<SceneSettings, &SceneSettings::threads>(
///         [&](const auto& field) { print(field.name, settings.*field.member); });
///
/// A member that a later version of graze adds is visited too, so `visit` has to take its type.
template <HasSettingsFields Struct, auto... left_out, typename Visit>
constexpr void for_each_field(const Visit& visit) {
  const auto visit_one = [&]<auto member>(const SettingsField<member>& field) {
    if constexpr (times_among<member, left_out...>() == 0) visit(field);
  };
  std::apply([&](const auto&... field) { (visit_one(field), ...); }, settings_fields<Struct>);
}

/// Returns the name of a member of Struct, such as "kind" for `&ObjectSettings::kind`.
template <HasSettingsFields Struct, auto member>
[[nodiscard]] constexpr std::string_view field_name() {
  std::string_view name;
  for_each_field<Struct>([&]<auto listed>(const SettingsField<listed>& field) {
    if (times_among<member, listed>() == 1) name = field.name;
  });
  return name;
}

/// Returns whether `members` are all members of Struct, each once. Where a part of a program treats each
/// member in its own way, a `static_assert` with this keeps it from forgetting one.
template <HasSettingsFields Struct, auto... members>
[[nodiscard]] constexpr bool are_all_fields() {
  return std::apply(
      []<auto... listed>(const SettingsField<listed>&...) {
        return sizeof...(members) == sizeof...(listed) && ((times_among<listed, members...>() == 1) && ...);
      },
      settings_fields<Struct>);
}

/// @}

}  // namespace graze
