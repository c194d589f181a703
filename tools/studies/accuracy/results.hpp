#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/kernels.hpp"
#include "accuracy/modes.hpp"
#include "accuracy/truth.hpp"

namespace graze::tools {

/// Settings of one detail that are compared with each other.
struct ModeTable {
  ContactDetail detail = ContactDetail::none;
  std::vector<ModeResult> results;  ///< the first is exact mode
  std::vector<ModeResult> timed;    ///< time budgets, whose answers depend on the machine
};

/// All that the page says.
struct AccuracyResults {
  std::uint64_t seed = 0;
  std::array<KernelStudy, 3> kernels;  ///< by InputKind
  std::uint32_t frames = 0;
  double edge_length = 0;
  double contact_distance = 0;
  std::vector<double> level_epsilon;
  TruthCheck truth;
  std::vector<ModeTable> modes;
  std::uint32_t runs = 1;  ///< of each setting, for the times
};

/// Lists violations of the contract, one sentence each. They are distances beyond their bound, wrong names,
/// bounds that are not exact in exact mode or do not hold in another, and contacts lost where none may be.
std::vector<std::string> violations_of(const AccuracyResults& results);

}  // namespace graze::tools
