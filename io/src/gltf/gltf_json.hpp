#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace graze::io {

/// A member of an object. It is null where there is none.
inline const nlohmann::json& member(const nlohmann::json& object, const char* key) {
  static const nlohmann::json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

/// An element of an array by a number in the file. It is null where there is none.
inline const nlohmann::json& element(const nlohmann::json& array, const nlohmann::json& number) {
  static const nlohmann::json nothing;
  if (!array.is_array() || !number.is_number_unsigned() || number.get<std::uint64_t>() >= array.size())
    return nothing;
  return array[number.get<std::size_t>()];
}

inline std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

/// A whole number, or 0 where there is none.
inline std::uint64_t number_of(const nlohmann::json& value) {
  return value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
}

}  // namespace graze::io
