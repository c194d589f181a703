#include "response/feature_points.hpp"

#include <array>
#include <graze/error.hpp>
#include <string>

namespace graze {

void refuse_feature(const PlacedMesh& placed, const Feature& feature, const char* function) {
  const std::string name = function;
  if (placed.positions.size() != placed.mesh.vertex_count())
    throw Error(name + ": " + std::to_string(placed.positions.size()) + " positions for a mesh of " +
                std::to_string(placed.mesh.vertex_count()) + " vertices");
  if (placed.positions.data() == nullptr) throw Error(name + ": the positions are null memory");
  const std::array names{"vertex", "edge", "face"};
  const auto kind = static_cast<std::size_t>(feature.kind);
  throw Error(name + ": the mesh has no " +
              (kind < names.size() ? names[kind] : "feature of kind " + std::to_string(kind) + " and index") +
              " " + std::to_string(feature.index));
}

}  // namespace graze
