#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace graze::tools {

/// What one study found: its figures, and what it was to check and does not hold.
struct StressResult {
  nlohmann::ordered_json figures;
  std::vector<std::string> violations;
};

}  // namespace graze::tools
