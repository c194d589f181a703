#include "response/feature_points.hpp"

#include <graze/error.hpp>
#include <string>

namespace graze {

void refuse_feature(const PlacedMesh& placed, const Feature& feature, const char* function) {
  const std::string name = function;
  if (placed.positions.size() != placed.mesh.vertex_count())
    throw Error(name + ": " + std::to_string(placed.positions.size()) + " positions for a mesh of " +
                std::to_string(placed.mesh.vertex_count()) + " vertices");
  throw Error(name + ": the mesh has no feature of kind " +
              std::to_string(static_cast<unsigned>(feature.kind)) + " and index " +
              std::to_string(feature.index));
}

}  // namespace graze
