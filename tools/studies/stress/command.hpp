#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

/// `graze_studies stress`: readers, many objects, long runs, and the same answer from any number of threads.
/// Throws graze::Error for bad input, CheckFailed where something that it checks does not hold.
void add_stress_command(CLI::App& app);

}  // namespace graze::tools
