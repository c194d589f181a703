#pragma once

#include <string>

namespace graze::demo {

/// The scene file, with the animated character's file in it.
std::string scene_text(const std::string& character_file);

}  // namespace graze::demo
