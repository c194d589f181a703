#include "mean_edge_length.hpp"

#include <cstdint>

namespace graze::tools {

double mean_edge_length(std::span<const std::shared_ptr<const Mesh>> meshes) {
  double sum = 0;
  double count = 0;
  for (const auto& mesh : meshes)
    for (std::uint32_t edge = 0; edge < mesh->edge_count(); ++edge) {
      const auto [low, high] = mesh->edge(edge);
      sum += (mesh->rest()[low] - mesh->rest()[high]).norm();
      count += 1;
    }
  return sum / count;
}

}  // namespace graze::tools
