#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/run.hpp"

namespace graze::bench {

/// One thing that is aimed at, in one scene: a measured figure that is to be at most, or at least, some
/// number.
struct Aim {
  std::string what;
  std::string where;
  double measured = 0;
  double wanted = 0;
  bool is_at_least = false;
  std::string note = {};

  [[nodiscard]] bool is_reached() const { return is_at_least ? measured >= wanted : measured <= wanted; }
};

/// Returns the aims that these runs can be measured by.
std::vector<Aim> aims_of(const std::vector<Run>& runs);

std::string table_of(const std::vector<Aim>& aims);
nlohmann::ordered_json figures_of(const std::vector<Aim>& aims);

}  // namespace graze::bench
