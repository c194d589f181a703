#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

/// `graze_studies bench`: graze, its peers and the limits on the same positions in one run. Throws
/// graze::Error for bad input, CheckFailed where an answer of graze is wrong.
void add_bench_command(CLI::App& app);

}  // namespace graze::tools
