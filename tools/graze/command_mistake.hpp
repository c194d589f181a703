#pragma once

#include <CLI/App.hpp>
#include <string>

namespace graze::tools {

/// What is wrong with a command line that could not be parsed, in one sentence. A command or option that does
/// not exist is named, with the nearest one that does.
std::string mistake_of(const CLI::App& app, const CLI::ParseError& error);

}  // namespace graze::tools
