#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

/// `graze_studies accuracy`: measures every kernel and every accuracy setting against exact arithmetic, and
/// writes the page with the tables and the figure. Throws graze::Error for bad input, CheckFailed where a
/// promise of the contract does not hold.
void add_accuracy_command(CLI::App& app);

}  // namespace graze::tools
