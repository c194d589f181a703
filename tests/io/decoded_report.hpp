#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/page/page_decoder.hpp"

namespace graze::tests {

inline std::uint64_t bits(double number) {
  return std::bit_cast<std::uint64_t>(number);
}

/// The report of one frame, in a block's table.
class DecodedReport {
 public:
  DecodedReport(const DecodedPage& page, std::uint64_t frame)
      : table_(*page.report(frame).first), index_(page.report(frame).second) {}

  [[nodiscard]] std::size_t pair_begin() const { return word("frame_pair_begin", index_); }
  [[nodiscard]] std::size_t pair_end() const { return word("frame_pair_end", index_); }
  [[nodiscard]] std::uint32_t word(const std::string& array, std::size_t index) const {
    return list<std::uint32_t>(words_, array).at(index);
  }
  [[nodiscard]] std::uint8_t byte(const std::string& array, std::size_t index) const {
    return list<std::uint8_t>(bytes_, array).at(index);
  }
  [[nodiscard]] std::uint64_t real_bits(const std::string& array, std::size_t index) const {
    return bits(list<double>(reals_, array).at(index));
  }
  /// The row of a pair's way out, or nothing where it has none.
  [[nodiscard]] std::optional<std::size_t> way_of(std::size_t pair) const { return row_of("way_pair", pair); }
  /// The row of what a pair met between two steps, or nothing where it has none.
  [[nodiscard]] std::optional<std::size_t> sweep_of(std::size_t pair) const {
    return row_of("sweep_pair", pair);
  }
  [[nodiscard]] const nlohmann::json& header() const { return table_.header(); }
  [[nodiscard]] std::size_t index() const { return index_; }

 private:
  /// The row of a pair in an array of ascending pairs.
  [[nodiscard]] std::optional<std::size_t> row_of(const std::string& array, std::size_t pair) const {
    if (!table_.has(array)) return std::nullopt;
    const auto& pairs = list<std::uint32_t>(words_, array);
    const auto found = std::ranges::lower_bound(pairs, pair);
    if (found == pairs.end() || *found != pair) return std::nullopt;
    return static_cast<std::size_t>(found - pairs.begin());
  }
  template <typename Number>
  const std::vector<Number>& list(std::map<std::string, std::vector<Number>>& known,
                                  const std::string& array) const {
    const auto found = known.find(array);
    if (found != known.end()) return found->second;
    return known.emplace(array, table_.numbers<Number>(array)).first->second;
  }

  const DecodedTable& table_;
  std::size_t index_;
  mutable std::map<std::string, std::vector<std::uint32_t>> words_;
  mutable std::map<std::string, std::vector<std::uint8_t>> bytes_;
  mutable std::map<std::string, std::vector<double>> reals_;
};

}  // namespace graze::tests
