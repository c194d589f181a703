#pragma once

#include <filesystem>
#include <string>

namespace graze::tools {

/// Throws io::InputError where an option's file cannot be written. So a long run does not end in vain. Leaves
/// a file as it is, and makes none.
void check_output_file(const std::string& option, const std::filesystem::path& file);

/// Throws io::InputError where a picture cannot be written, also since its ending is that of no format that
/// pictures have.
void check_picture_file(const std::string& option, const std::filesystem::path& file);

}  // namespace graze::tools
