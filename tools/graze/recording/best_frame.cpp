#include "recording/best_frame.hpp"

namespace graze::tools {

std::size_t best_frame(const Recording& recording, const FrameRange& range) {
  std::size_t best = range.first;
  std::uint64_t most = 0;
  for (std::size_t index = range.first; index <= range.last && index < recording.frame_count(); ++index)
    if (const std::uint64_t contacts = recording.frame(index).contacts; contacts > most) {
      most = contacts;
      best = index;
    }
  return best;
}

}  // namespace graze::tools
