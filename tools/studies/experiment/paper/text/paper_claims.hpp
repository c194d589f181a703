#pragma once

#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// Compares each statement of section 4 about one experiment, given by its number, with the measurements.
std::vector<Claim> claims_of(int experiment, const PaperResults& results);

/// Compares the paper's statement that the human "can be decomposed" with the measurements.
Claim parts_claim(const PaperResults& whole, const PaperResults& parts);

}  // namespace graze::tools
