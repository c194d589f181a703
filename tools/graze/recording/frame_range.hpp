#pragma once

#include <cstddef>
#include <string>

namespace graze::tools {

/// Frames of a recording, counted from 0. Both ends belong to it.
struct FrameRange {
  std::size_t first = 0;
  std::size_t last = static_cast<std::size_t>(-1);
};

/// Reads `A..B`, `A..`, `..B` or `A` for a recording of so many frames. The end is at most its last frame.
/// Throws io::InputError, which names the option, for another text and where the recording has no such frame.
FrameRange parse_frame_range(const std::string& option, const std::string& text, std::size_t frame_count);

}  // namespace graze::tools
