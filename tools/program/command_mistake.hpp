#pragma once

#include <CLI/App.hpp>
#include <map>
#include <string>

namespace graze::tools {

/// Says in one sentence why a command line could not be parsed. A command or option that does
/// not exist is named, with the nearest one that does. `moved` are commands that other programs have, with
/// these programs.
std::string mistake_of(const CLI::App& app, const CLI::ParseError& error,
                       const std::map<std::string, std::string>& moved);

}  // namespace graze::tools
