#include "export/csv_line.hpp"

#include <array>
#include <charconv>

namespace graze::io {

void CsvLine::separate() {
  if (!is_at_start_) lines_ += ',';
  is_at_start_ = false;
}

CsvLine& CsvLine::text(std::string_view value) {
  separate();
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    lines_ += value;
    return *this;
  }
  lines_ += '"';
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
