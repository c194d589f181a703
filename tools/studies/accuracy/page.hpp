#pragma once

#include <string>

#include "accuracy/results.hpp"

namespace graze::tools {

/// The page in Markdown. With a name of a figure it ends with what was timed. Without, it is the same for the
/// same seed on every machine.
std::string page_of(const AccuracyResults& results, const std::string& figure);

}  // namespace graze::tools
