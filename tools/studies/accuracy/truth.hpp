#pragma once

#include <cstdint>

#include "accuracy/models.hpp"
#include "accuracy/modes.hpp"

namespace graze::tools {

/// How exact mode on the moving models, the measure of all other settings, compared with exact arithmetic.
struct TruthCheck {
  std::uint64_t pair_rows = 0;  ///< in all frames
  std::uint64_t checked = 0;    ///< of those, for surfaces and for vertices
  std::uint64_t contacts = 0;   ///< of `features`, `regions` and `vertices`
  std::uint64_t wrong = 0;  ///< bounds that are not the truth rounded, and sets that are not the true ones
};

/// Compares one in `every` pairs, counted through all frames, with the oracle.
TruthCheck check_truth(const MovingModels& models, const ModeStudy& study, std::uint32_t every);

}  // namespace graze::tools
