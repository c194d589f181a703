#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace graze::io {

/// Parses a whole JSON file. Throws InputError for a file that cannot be read, a syntax error (with line and
/// column) and a key that an object has twice.
nlohmann::json parse_json_file(const std::filesystem::path& path);

/// A JSON value that knows where it stands, so that what is wrong with it can be said in one line. Every
/// reading member throws InputError: `scene.json: objects[2].margin: expected …, got "x"; remedy`. The value
/// must outlive it.
class JsonPath {
 public:
  JsonPath(std::string file, const nlohmann::json& value) : file_(std::move(file)), value_(&value) {}

  [[nodiscard]] const nlohmann::json& value() const { return *value_; }
  /// `scene.json: objects[2].margin`. It is the file alone for the whole document.
  [[nodiscard]] std::string where() const;
  /// The last key of the path, such as `margin`.
  [[nodiscard]] std::string_view key() const;
  [[noreturn]] void fail(std::string_view expected, std::string_view remedy) const;
  [[noreturn]] void refuse(std::string_view problem) const;

  /// An object with no other keys than these.
  void expect_keys(std::initializer_list<std::string_view> keys) const { expect_keys(std::span(keys)); }
  void expect_keys(std::span<const std::string_view> keys) const;
  [[nodiscard]] std::optional<JsonPath> find(std::string_view key) const;
  [[nodiscard]] JsonPath require(std::string_view key, std::string_view remedy) const;

  /// An array's length. `item(i)` gives its parts.
  [[nodiscard]] std::size_t array_size(std::string_view remedy) const;
  [[nodiscard]] JsonPath item(std::size_t index) const;

  [[nodiscard]] bool truth() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] double number_not_negative() const;
  [[nodiscard]] double number_positive() const;
  [[nodiscard]] std::uint32_t whole_number(std::uint32_t least, std::uint32_t most) const;
  [[nodiscard]] std::string text() const;
  /// Three numbers.
  [[nodiscard]] Eigen::Vector3d point() const;
  /// An array of so many numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t count, std::string_view remedy) const;

 private:
  JsonPath(std::string file, std::string path, const nlohmann::json& value)
      : file_(std::move(file)), path_(std::move(path)), value_(&value) {}

  std::string file_;
  std::string path_;
  const nlohmann::json* value_;
};

}  // namespace graze::io
