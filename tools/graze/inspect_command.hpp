#pragma once

#include <CLI/App.hpp>

namespace graze::tools {

/// `graze inspect`: what mesh files hold. Throws graze::Error for bad input.
void add_inspect_command(CLI::App& app);

}  // namespace graze::tools
