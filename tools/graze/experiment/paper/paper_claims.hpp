#pragma once

#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// What section 4 says of the experiment of a number, beside what was measured.
std::vector<Claim> claims_of(int experiment, const PaperResults& results);

/// What it says of the human that "can be decomposed".
Claim parts_claim(const PaperResults& whole, const PaperResults& parts);

}  // namespace graze::tools
