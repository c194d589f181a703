#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

namespace graze::io {

/// Builds lines of CSV from left to right, and places the commas. Doubles come back to the same bits.
class CsvLine {
 public:
  /// A text that a spreadsheet may take for a formula gets an apostrophe in front.
  CsvLine& text(std::string_view value);
  CsvLine& whole(std::uint64_t value);
  CsvLine& real(double value);
  CsvLine& point(const Eigen::Vector3d& value);
  CsvLine& flag(bool value);
  CsvLine& empty();
  void end();

  [[nodiscard]] const std::string& lines() const { return lines_; }
  void clear() { lines_.clear(); }

 private:
  void separate();

  std::string lines_;
  bool is_at_start_ = true;  ///< of a line
};

}  // namespace graze::io
