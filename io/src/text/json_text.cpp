#include "text/json_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace graze::io {
namespace {

/// Spells out DEL and the control characters of two bytes, U+0080 to U+009F. JSON may hold them as they are,
/// but a terminal that shows the file obeys them.
std::string without_late_controls(const std::string& text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    const bool is_pair = byte == 0xC2 && next >= 0x80 && next < 0xA0;
    if (!is_pair && byte != 0x7F) {
      escaped += text[i];
      continue;
    }
    const unsigned code = is_pair ? next : byte;
    escaped += "\\u00";
    escaped += {digits[code >> 4U], digits[code & 15U]};
    if (is_pair) ++i;
  }
  return escaped;
}

}  // namespace

void JsonText::separate() {
  if (line_.empty()) return;
  const char last = line_.back();
  if (last != '{' && last != '[' && last != ':') line_ += ',';
}

JsonText& JsonText::open(char bracket) {
  separate();
  line_ += bracket;
  return *this;
}

JsonText& JsonText::close(char bracket) {
  line_ += bracket;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  separate();
  line_ += '"';
  line_ += name;
  line_ += "\":";
  return *this;
}

JsonText& JsonText::text(std::string_view value) {
  separate();
  // Names may hold anything. Bytes that are not UTF-8 are replaced rather than thrown at.
  line_ += without_late_controls(
      nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  return *this;
}

JsonText& JsonText::whole(std::uint64_t value) {
  separate();
  line_ += std::to_string(value);
  return *this;
}

JsonText& JsonText::real(double value) {
  if (std::isnan(value)) return null();
  if (std::isinf(value)) return text(value > 0 ? "infinity" : "-infinity");
  separate();
  if (value == 0 && std::signbit(value)) {
    line_ += "-0.0";  // readers take "-0" for the integer 0
    return *this;
  }
  std::array<char, 32> digits;
  const auto* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  line_.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
  return *this;
}

JsonText& JsonText::flag(bool value) {
  separate();
  line_ += value ? "true" : "false";
  return *this;
}

JsonText& JsonText::null() {
  separate();
  line_ += "null";
  return *this;
}

JsonText& JsonText::point(const Eigen::Vector3d& value) {
  open('[');
  for (int axis = 0; axis < 3; ++axis) real(value[axis]);
  return close(']');
}

}  // namespace graze::io
