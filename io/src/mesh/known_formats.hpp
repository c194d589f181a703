#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace graze::io {

/// The name of a format that graze does not read, by its extension in lower case with the dot, such as "VTK"
/// for ".vtk". Nothing for every other extension.
std::optional<std::string> name_of_unread_format(std::string_view extension);

}  // namespace graze::io
