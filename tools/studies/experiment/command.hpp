#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

/// `graze_studies experiment`: the paper's experiments and the questions that it leaves open, as CSV, one
/// HTML file and a document with images. Throws graze::Error for bad input, CheckFailed where what has to
/// hold does not.
void add_experiment_command(CLI::App& app);

}  // namespace graze::tools
