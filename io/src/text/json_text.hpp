#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

namespace graze::io {

/// Builds one line of JSON from left to right, and places the commas. Doubles come back to the same bits.
/// Those that JSON has no number for are "infinity", "-infinity" and null.
class JsonText {
 public:
  JsonText& open(char bracket);
  JsonText& close(char bracket);
  JsonText& key(std::string_view name);
  JsonText& text(std::string_view value);
  JsonText& whole(std::uint64_t value);
  JsonText& real(double value);
  JsonText& flag(bool value);
  JsonText& null();
  JsonText& point(const Eigen::Vector3d& value);

  [[nodiscard]] const std::string& line() const { return line_; }
  void clear() { line_.clear(); }

 private:
  void separate();

  std::string line_;
};

}  // namespace graze::io
