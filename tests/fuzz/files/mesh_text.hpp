#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "mesh/raw_object.hpp"

namespace graze::fuzz {

enum class MeshFormat : std::uint8_t { obj, ply, off };
inline constexpr std::array mesh_formats = {MeshFormat::obj, MeshFormat::ply, MeshFormat::off};

/// `.obj`, `.ply` or `.off`.
std::string extension_of(MeshFormat format);

/// The surface as a text of that format, every number so that it reads back as the same double.
std::string mesh_text(MeshFormat format, const io::RawSurface& surface);

}  // namespace graze::fuzz
