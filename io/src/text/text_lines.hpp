#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace graze::io {

/// Lines of a text, whichever way they end. The text must outlive this.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  /// The next line without its end. It is empty at the end of the text.
  std::string_view next() {
    const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    ++line_;
    return line;
  }

  /// The number of the line that `next` gave last, counted from 1.
  [[nodiscard]] std::size_t line() const { return line_; }
  /// The text behind the line that `next` gave last.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t line_ = 0;
};

/// The longest message and the longest name in bytes. A file may hold a word of any length.
inline constexpr std::size_t longest_message = 2000;
inline constexpr std::size_t longest_name = 1000;

/// A text of at most `longest` bytes, which are more than 8. What is too long loses its middle, so that a
/// message keeps its file and its remedy. No letter of UTF-8 is cut in two.
inline std::string shortened(std::string text, std::size_t longest) {
  if (text.size() <= longest) return text;
  const auto is_inside_letter = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  std::size_t begin = longest / 2;
  std::size_t end = text.size() - (longest - begin - 3);
  for (int step = 0; step < 3 && is_inside_letter(begin); ++step) --begin;
  for (int step = 0; step < 3 && is_inside_letter(end); ++step) ++end;
  return text.replace(begin, end - begin, "...");
}

/// Without blanks at both ends.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\v\f\r";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// The line up to its comment, which `#` begins. In `1.#IND`, a NaN of some platforms, it does not.
inline std::string_view without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    const char next = at + 1 < line.size() ? line[at + 1] : ' ';
    const bool is_number =
        line.substr(0, at).ends_with("1.") && ((next >= 'A' && next <= 'Z') || (next >= 'a' && next <= 'z'));
    if (!is_number) return line.substr(0, at);
  }
  return line;
}

}  // namespace graze::io
