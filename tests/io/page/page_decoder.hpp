#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"

namespace graze::tests {

/// The chunks of a page or of its data, by name, as docs/page_format.md says. It shares no code with the
/// library.
std::map<std::string, std::string> chunks_of(const std::filesystem::path& file);

/// A table of a page.
class DecodedTable {
 public:
  DecodedTable() = default;
  explicit DecodedTable(const std::string& bytes);

  [[nodiscard]] const nlohmann::json& header() const { return header_; }
  [[nodiscard]] bool has(const std::string& name) const { return header_["arrays"].contains(name); }
  template <typename Number>
  [[nodiscard]] std::vector<Number> numbers(const std::string& name) const {
    const nlohmann::json& array = header_.at("arrays").at(name);
    const std::string type = sizeof(Number) == 1 ? "u8" : sizeof(Number) == 4 ? "u32" : "f64";
    REQUIRE(array.at("type") == type);
    const std::size_t offset = array.at("offset");
    REQUIRE(offset % 8 == 0);
    std::vector<Number> result(array.at("count").get<std::size_t>());
    REQUIRE(offset + result.size() * sizeof(Number) <= arrays_.size());
    if (!result.empty()) std::memcpy(result.data(), arrays_.data() + offset, result.size() * sizeof(Number));
    return result;
  }

 private:
  nlohmann::json header_;
  std::string arrays_;
};

/// The place of an object in a frame: positions of a deformable one, else the rows of a pose.
struct DecodedShape {
  std::vector<std::optional<Eigen::Vector3d>> positions;  ///< nothing for a vertex that is not drawn
  std::array<double, 12> pose{};
};

/// A page that is read as its viewer reads it.
class DecodedPage {
 public:
  explicit DecodedPage(const std::filesystem::path& file);

  [[nodiscard]] const nlohmann::json& head() const { return head_; }
  [[nodiscard]] std::size_t frame_count() const { return head_.at("frames"); }
  [[nodiscard]] std::uint64_t block() const { return head_.at("block"); }
  [[nodiscard]] const DecodedTable& mesh(std::size_t number) const;
  /// The report of the block that has a frame, and the frame's index in it.
  [[nodiscard]] std::pair<const DecodedTable*, std::size_t> report(std::uint64_t frame) const;
  /// The place of an object in a frame. Nothing where no track of the frame's block has it.
  [[nodiscard]] std::optional<DecodedShape> shape(std::size_t object, std::uint64_t frame) const;
  /// How often the track of an object in a block has a new position.
  [[nodiscard]] std::vector<std::uint64_t> track_frames(std::size_t object, std::uint64_t block) const;

 private:
  [[nodiscard]] const nlohmann::json* track(std::size_t object, std::uint64_t block) const;

  nlohmann::json head_;
  std::map<std::string, DecodedTable> tables_;
};

}  // namespace graze::tests
