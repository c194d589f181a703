#pragma once

#include <filesystem>
#include <span>

#include "figures/figure.hpp"

namespace graze::tools {

/// Figures that are drawn beside each other, and the file of the image: an SVG or a PNG by its name.
struct Drawing {
  std::span<const Figure> panels;
  std::filesystem::path path;
};

/// Whether gnuplot, which draws figures, can be run.
bool has_gnuplot();

/// Draws with gnuplot on a white ground. On a logarithmic axis 0 is drawn a decade below all else, and marked
/// so. Throws io::InputError where gnuplot fails.
void draw(std::span<const Drawing> drawings);

}  // namespace graze::tools
