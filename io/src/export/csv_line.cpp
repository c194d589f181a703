#include "export/csv_line.hpp"

#include <array>
#include <charconv>

namespace graze::io {
namespace {

/// Whether a spreadsheet may take a text for a formula. An apostrophe counts too. It is what such texts get
/// in front, so a reader that removes one apostrophe has every text back.
bool begins_like_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r\n'").find(text.front()) != std::string_view::npos;
}

}  // namespace

void CsvLine::separate() {
  if (!is_at_start_) lines_ += ',';
  is_at_start_ = false;
}

CsvLine& CsvLine::text(std::string_view value) {
  separate();
  const bool is_formula = begins_like_formula(value);
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    if (is_formula) lines_ += '\'';
    lines_ += value;
    return *this;
  }
  lines_ += '"';
  if (is_formula) lines_ += '\'';
  for (const char letter : value) {
    if (letter == '"') lines_ += '"';
    lines_ += letter;
  }
  lines_ += '"';
  return *this;
}

CsvLine& CsvLine::whole(std::uint64_t value) {
  separate();
  lines_ += std::to_string(value);
  return *this;
}

CsvLine& CsvLine::real(double value) {
  separate();
  std::array<char, 32> digits;
  const auto* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  lines_.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
  return *this;
}

CsvLine& CsvLine::point(const Eigen::Vector3d& value) {
  for (int axis = 0; axis < 3; ++axis) real(value[axis]);
  return *this;
}

CsvLine& CsvLine::flag(bool value) {
  return text(value ? "true" : "false");
}

CsvLine& CsvLine::empty() {
  separate();
  return *this;
}

void CsvLine::end() {
  lines_ += '\n';
  is_at_start_ = true;
}

}  // namespace graze::io
