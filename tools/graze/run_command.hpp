#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

/// `graze run`: steps through a scene, prints a summary, writes a report and a picture. Throws graze::Error
/// for bad input.
void add_run_command(CLI::App& app);

}  // namespace graze::tools
