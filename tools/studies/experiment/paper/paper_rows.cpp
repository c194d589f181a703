#include "experiment/paper/paper_rows.hpp"

#include <algorithm>
#include <stdexcept>

#include "output/text.hpp"

namespace graze::tools {
namespace {

constexpr std::array<std::uint32_t, 2> first_and_first = {0, 0};
constexpr std::array<std::uint32_t, 2> first_and_second = {0, 1};
constexpr std::array<std::uint32_t, 2> second_and_second = {1, 1};

using Numbers = std::array<double, 3>;

std::vector<double> list_of(const Numbers& numbers) {
  return {numbers.begin(), numbers.end()};
}

std::vector<PaperRow> rows_of(const std::vector<std::vector<RowRule>>& rules) {
  std::vector<PaperRow> rows;
  rows.reserve(rules.size());
  for (const std::vector<RowRule>& row : rules)
    rows.push_back({"row " + std::to_string(rows.size() + 1), row});
  return rows;
}

/// Table 2: tori and pawns alike.
std::vector<PaperRow> table_2() {
  std::vector<std::vector<RowRule>> rows;
  for (const Numbers& numbers : {Numbers{20, 14, 8}, {22, 14, 8}, {24, 14, 8}, {30, 14, 8}, {30, 20, 10}})
    rows.push_back({{first_and_first, list_of(numbers)},
                    {first_and_second, list_of(numbers)},
                    {second_and_second, list_of(numbers)}});
  return rows_of(rows);
}

/// Table 3: of human and human, and of human and torus.
std::vector<PaperRow> table_3() {
  const std::array<std::array<Numbers, 2>, 5> table = {{{{{20, 15, 10}, {25, 20, 10}}},
                                                        {{{45, 30, 10}, {35, 30, 10}}},
                                                        {{{25, 15, 10}, {35, 30, 10}}},
                                                        {{{40, 25, 10}, {40, 30, 10}}},
                                                        {{{25, 15, 10}, {45, 30, 10}}}}};
  std::vector<std::vector<RowRule>> rows;
  rows.reserve(table.size());
  for (const auto& [humans, torus] : table)
    rows.push_back({{first_and_first, list_of(humans)}, {first_and_second, list_of(torus)}});
  return rows_of(rows);
}

/// Table 4: of tooth and cylinder.
std::vector<PaperRow> table_4() {
  std::vector<std::vector<RowRule>> rows;
  for (const Numbers& numbers : {Numbers{20, 15, 10}, {25, 12, 8}, {25, 13, 10}, {25, 15, 8}, {30, 15, 10}})
    rows.push_back({{first_and_second, list_of(numbers)}});
  return rows_of(rows);
}

}  // namespace

const std::vector<double>& PaperRow::epsilon(std::uint32_t kind_a, std::uint32_t kind_b) const {
  const std::array kinds = {std::min(kind_a, kind_b), std::max(kind_a, kind_b)};
  const auto found = std::ranges::find_if(rules, [&](const RowRule& rule) { return rule.kinds == kinds; });
  if (found == rules.end()) throw std::out_of_range("the paper has no numbers for these two kinds");
  return found->epsilon;
}

std::string PaperRow::numbers() const {
  const bool alike =
      std::ranges::all_of(rules, [&](const RowRule& rule) { return rule.epsilon == rules[0].epsilon; });
  std::string text;
  for (std::size_t level = 0; level < rules[0].epsilon.size(); ++level) {
    text += level == 0 ? "" : " / ";
    text += format("%g", rules[0].epsilon[level]);
    if (!alike) text += format(", %g", rules[1].epsilon[level]);
  }
  return text;
}

std::vector<PaperRow> paper_rows(int experiment) {
  if (experiment == 1) return table_2();
  return experiment == 2 ? table_3() : table_4();
}

}  // namespace graze::tools
