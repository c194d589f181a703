#pragma once

#include <filesystem>
#include <span>

#include "figure.hpp"

namespace graze::tools {

/// A figure and the file that it is drawn into: an SVG or a PNG by its name.
struct Drawing {
  const Figure* figure;
  std::filesystem::path path;
};

/// Draws with gnuplot on a white ground. On a logarithmic axis 0 is drawn a decade below all else, and marked
/// so. Throws io::InputError where gnuplot fails.
void draw(std::span<const Drawing> drawings);

}  // namespace graze::tools
