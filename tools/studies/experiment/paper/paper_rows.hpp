#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace graze::tools {

/// The numbers of a row for two kinds of objects.
struct RowRule {
  std::array<std::uint32_t, 2> kinds{};
  std::vector<double> epsilon;  ///< of level 1, of level 2, and of the last step between vertices
};

/// One row of the paper's table 2, 3 or 4. Kinds without a rule cannot meet.
struct PaperRow {
  std::string name;
  std::vector<RowRule> rules;

  /// The last number, which all rules of a row share.
  [[nodiscard]] double last() const { return rules[0].epsilon.back(); }
  /// The numbers for two kinds, in either order.
  [[nodiscard]] const std::vector<double>& epsilon(std::uint32_t kind_a, std::uint32_t kind_b) const;
  /// As in the paper's tables.
  [[nodiscard]] std::string numbers() const;
};

/// The five rows of the experiment of a number, 1 to 3.
std::vector<PaperRow> paper_rows(int experiment);

/// The third row's place, which the paper finds best in every experiment.
inline constexpr std::size_t best_row = 2;

}  // namespace graze::tools
