#pragma once

#include <string>
#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// Collisions found and reported in each step, as the paper's figures 9 to 11, and the time of each step. The
/// names begin with `prefix`, the titles end with `of`.
std::vector<Figure> figures_of(const PaperResults& results, const std::string& prefix, const std::string& of);

}  // namespace graze::tools
