#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace graze::bench {

/// One triangle's vertices, counted within its object.
struct Triangle {
  std::uint32_t corners[3];
};

struct WorldObject {
  std::size_t first_vertex = 0;  ///< in World::positions
  std::uint32_t vertex_count = 0;
  std::span<const Triangle> triangles;  ///< of its mesh, in the mesh's order
  bool is_fixed = false;
};

/// The positions of everything in the present frame, which all contenders read. It consists of plain numbers
/// only, since contenders are compiled for other instruction sets than the rest of the program.
struct World {
  double distance = 0;  ///< threshold and range of every task
  std::vector<WorldObject> objects;
  std::vector<float> positions;  ///< x, y, z of all vertices, object after object
  /// How far, at most, any vertex of each object is from where it was in the frame before. 0 means that
  /// nothing changed.
  std::vector<double> displacements;
  /// For each object, how often it has changed.
  std::vector<std::uint64_t> versions;

  [[nodiscard]] const float* positions_of(std::size_t object) const {
    return positions.data() + 3 * objects[object].first_vertex;
  }
};

}  // namespace graze::bench
