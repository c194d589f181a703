#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace graze::tools {

/// The result of one study: its figures, and the checks that failed.
struct StressResult {
  nlohmann::ordered_json figures;
  std::vector<std::string> violations;
};

}  // namespace graze::tools
