#include "recording/frame_range.hpp"

#include <algorithm>
#include <charconv>
#include <graze/io/error.hpp>
#include <string_view>

namespace graze::tools {
namespace {

/// The range that a text names, whatever the recording has.
FrameRange parse(const std::string& option, const std::string& text) {
  const io::InputError refusal(option + ": expected frames as 10..20, 10.., ..20 or 10, got \"" + text +
                               "\"");
  const auto number = [&](std::string_view digits) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) throw refusal;
    return value;
  };
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) return {number(text), number(text)};
  FrameRange range;
  if (dots > 0) range.first = number(std::string_view(text).substr(0, dots));
  if (dots + 2 < text.size()) range.last = number(std::string_view(text).substr(dots + 2));
  if (text.size() == 2 || range.first > range.last) throw refusal;
  return range;
}

}  // namespace

FrameRange parse_frame_range(const std::string& option, const std::string& text, std::size_t frame_count) {
  FrameRange range = parse(option, text);
  if (range.first >= frame_count)
    throw io::InputError(option + ": the recording has " + std::to_string(frame_count) +
                         " frames, counted from 0");
  range.last = std::min(range.last, frame_count - 1);
  return range;
}

}  // namespace graze::tools
