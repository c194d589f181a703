#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/surface/surface.hpp"

namespace graze {

/// A copy of some leaves of a surface, for searches that look nowhere else. All else of the mesh is far away
/// from everything: its vertices stand at one place beyond reach, and so do the boxes of its regions. So the
/// features have the numbers that the mesh gives them, and a search never comes to those that are not there.
///
/// A search may say what it says of the whole surface about all that is nearer than the nearest leaf that is
/// not there. The faces around such a feature are as near as the feature, so that their leaves are there. The
/// sides of an edge ask for more: the faces around its ends. Their corners are copied, too.
class GRAZE_API SurfacePart {
 public:
  /// Nothing is there yet.
  explicit SurfacePart(std::shared_ptr<const Mesh> mesh);

  /// Takes leaves of a surface of the same mesh, by their numbers in ascending order, in place of what was
  /// there. It takes memory only if it has had positions in the other precision, or fewer leaves, before.
  void take(const Surface& from, std::span<const std::uint32_t> leaves);
  /// Takes all of a surface, as it would be after `refit_faces`.
  void take_all(const Surface& from);

  /// Its bounds are those of `refit_faces`. Only its positions, its box and these bounds mean anything.
  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void clear(bool in_double);
  void clear_all();
  void copy_around(const Surface& from, std::span<const std::uint32_t> vertices);
  void copy(const PositionView& positions, std::uint32_t vertex);
  void box_leaf(std::uint32_t leaf);
  void box_long_regions();
  void begin_version();

  Surface surface_;
  std::vector<std::uint32_t> leaves_;
  std::vector<std::uint32_t> inner_;     ///< the regions that contain these leaves
  std::vector<std::uint32_t> vertices_;  ///< those that are there
  bool has_all_ = false;
};

}  // namespace graze
