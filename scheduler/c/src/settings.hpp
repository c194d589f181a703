#pragma once

#include <graze/graze.h>

#include <cstring>
#include <graze/query.hpp>
#include <graze/recorder.hpp>
#include <graze/settings.hpp>
#include <graze/settings_fields.hpp>
#include <tuple>
#include <type_traits>

#include "calls.hpp"

// Settings of the C interface, and the C++ settings that they mean.

namespace graze::c {

// Each of these has an overload for each struct of settings. `to_c` makes what `from_c` takes: it points into
// the C++ settings, which have to stay.

[[nodiscard]] graze_scene_settings to_c(const SceneSettings& settings);
[[nodiscard]] graze_object_settings to_c(const ObjectSettings& settings);
[[nodiscard]] graze_pair_rule to_c(const PairRule& rule);
[[nodiscard]] graze_scene_capacity to_c(const SceneCapacity& capacity);
[[nodiscard]] graze_query_settings to_c(const QuerySettings& settings);
/// The default settings of a recorder. One struct of C has those of recorders into files and of rings.
[[nodiscard]] graze_recorder_settings default_recorder_settings();

[[nodiscard]] SceneSettings from_c(const graze_scene_settings& settings);
[[nodiscard]] ObjectSettings from_c(const graze_object_settings& settings);
[[nodiscard]] PairRule from_c(const graze_pair_rule& rule);
[[nodiscard]] SceneCapacity from_c(const graze_scene_capacity& capacity);
[[nodiscard]] QuerySettings from_c(const graze_query_settings& settings);
[[nodiscard]] RecorderSettings recorder_settings_from_c(const graze_recorder_settings& settings);
[[nodiscard]] RingSettings ring_settings_from_c(const graze_recorder_settings& settings);

/// Whether `members` are all members of a struct of C++ that has no list of its own. A member that it gets
/// then stops the build where it has to be given to C as well.
template <typename Struct, auto... members>
[[nodiscard]] constexpr bool has_members() {
  return has_every_member<Struct>(std::tuple{SettingsField<members>{""}...});
}

/// Throws BadArgument for a size that no version of a struct has: one without room for the size itself, and
/// one that no program can mean.
void check_struct_size(std::size_t struct_size, const char* name);

/// Fills a caller's struct of `struct_size` bytes. Bytes beyond the members that this library has become 0.
template <typename Struct>
void fill(Struct* room, std::size_t struct_size, Struct values, const char* name) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  static_cast<void>(given(room, name));
  check_struct_size(struct_size, name);
  values.struct_size = struct_size;
  std::memset(static_cast<void*>(room), 0, struct_size);
  std::memcpy(static_cast<void*>(room), &values, std::min(struct_size, sizeof values));
}

/// Reads a caller's struct, which may be smaller or larger than this library's. Members that it does not have
/// are those of `defaults`. Throws BadArgument if it has members that this library does not know, and that
/// are not 0.
template <typename Struct>
[[nodiscard]] Struct whole(const Struct& read, Struct defaults, const char* name) {
  check_struct_size(read.struct_size, name);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&read);
  for (std::size_t byte = sizeof read; byte < read.struct_size; ++byte)
    if (bytes[byte] != 0)
      throw BadArgument(std::string(name) + " asks for what a later version of graze has: it has " +
                        std::to_string(read.struct_size) + " bytes, and here it has " +
                        std::to_string(sizeof read));
  std::memcpy(static_cast<void*>(&defaults), bytes, std::min(read.struct_size, sizeof defaults));
  return defaults;
}

/// Returns the C++ settings of a caller's struct, or the default ones for null.
template <typename Settings, typename Struct>
[[nodiscard]] Settings read_settings(const Struct* read, const char* name) {
  if (read == nullptr) return {};
  const Settings defaults;
  return from_c(whole(*read, to_c(defaults), name));
}

}  // namespace graze::c
