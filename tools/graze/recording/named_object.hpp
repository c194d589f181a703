#pragma once

#include <graze/recording.hpp>
#include <string>

namespace graze::tools {

/// Whether a word of the command line names an object of a recording: by its name, or by its serial, which
/// `graze info` lists.
inline bool is_named(const ReplayObject& object, const std::string& word) {
  return word == object.settings.name || word == std::to_string(object.serial);
}

}  // namespace graze::tools
