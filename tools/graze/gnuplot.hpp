#pragma once

#include <string>

namespace graze::tools {

/// Whether gnuplot, which draws figures, can be run.
bool has_gnuplot();

/// Runs a script. Throws io::InputError, with `what` in it, where gnuplot fails.
void run_gnuplot(const std::string& script, const std::string& what);

/// As gnuplot reads it back: in single quotes.
std::string gnuplot_quoted(const std::string& text);

}  // namespace graze::tools
