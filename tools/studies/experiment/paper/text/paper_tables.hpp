#pragma once

#include <string>
#include <vector>

#include "experiment/paper/paper_results.hpp"
#include "experiment/recorded_motion.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// The tables of an experiment. The names of all begin with `prefix`, the titles end with `of`.
std::vector<ResultTable> tables_of(const RecordedMotion& motion, const PaperResults& results,
                                   const std::string& prefix, const std::string& of);

}  // namespace graze::tools
