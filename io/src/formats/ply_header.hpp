#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graze::io {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

/// A number of each row of an element, or a list of them behind its length.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> length_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t row_count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t body_begin = 0;  ///< in bytes
};

/// Exactly one element is called `vertex`. Throws InputError.
PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes);

}  // namespace graze::io
