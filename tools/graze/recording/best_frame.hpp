#pragma once

#include <cstddef>
#include <graze/recording.hpp>

#include "recording/frame_range.hpp"

namespace graze::tools {

/// The frame of a range with most contacts, the first of several. The range begins in the recording.
std::size_t best_frame(const Recording& recording, const FrameRange& range = {});

}  // namespace graze::tools
