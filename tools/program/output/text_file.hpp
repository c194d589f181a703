#pragma once

#include <filesystem>
#include <string>

namespace graze::tools {

/// The bytes of a file. Throws io::InputError where it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

/// Throws io::InputError where it cannot be written to its end.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace graze::tools
