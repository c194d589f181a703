#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <string>
#include <vector>

#include "mesh/raw_object.hpp"

namespace graze::io {

/// Compares the faces of the frames of a sequence with those of the mesh that the frames move.
class FrameFaces {
 public:
  explicit FrameFaces(const Mesh& mesh);

  /// Says how the faces of a frame differ from those of the mesh. Empty where they do not, and where the
  /// frame has no faces. Faces may come in another order, and larger ones may be cut into triangles.
  std::string difference(const RawSurface& frame);

 private:
  [[nodiscard]] bool is_known(std::span<const std::uint32_t> face) const;

  std::vector<std::uint64_t> edges_;  ///< pairs of vertices, sorted
  std::size_t triangles_ = 0;
  std::vector<std::uint32_t> last_corners_;  ///< of a frame that had no difference
};

}  // namespace graze::io
