#include "accuracy/moving_surfaces.hpp"

#include <algorithm>

#include "core/surface/surface.hpp"

namespace graze::tools {

std::vector<double> largest_level_epsilon(std::span<const std::shared_ptr<const Mesh>> meshes) {
  std::vector<double> largest;
  for (const auto& mesh : meshes) {
    Surface surface(mesh);
    surface.refit_vertices();
    surface.refit(RefitOf::radii);
    const auto radii = surface.level_radii();
    largest.resize(std::max(largest.size(), radii.size()));
    for (std::size_t level = 0; level < radii.size(); ++level)
      largest[level] = std::max(largest[level], 2 * radii[level]);
  }
  return largest;
}

}  // namespace graze::tools
