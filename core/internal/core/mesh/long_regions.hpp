#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <span>
#include <vector>

namespace graze {

class IndexedMesh;

/// The leaves of a mesh whose faces are long at rest, and the regions that contain them. Of a long face that
/// lies across the axes, a box along the axes is mostly empty. So a surface has boxes along the faces for
/// these regions (OrientedBox). Most meshes have no such region.
class GRAZE_API LongRegions {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  struct LongRegion {
    std::uint32_t region = 0;
    /// Corners of a long face in it, which say along which axes its box lies: the ends of a long side, and a
    /// corner that is far from the line through these.
    std::array<std::uint32_t, 3> corners{};
  };

  LongRegions() = default;
  /// Finds the long regions of a mesh whose octree is built.
  explicit LongRegions(const IndexedMesh& mesh);

  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] std::size_t count() const { return all_.size(); }
  /// Ordered by descending number, so that a region comes after all those that it contains.
  [[nodiscard]] std::span<const LongRegion> all() const { return all_; }
  /// The index of a region among all, or `none`. Call it only if there are any.
  [[nodiscard]] std::uint32_t index_of(std::uint32_t region) const { return index_of_[region]; }

  /// Bytes held.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  std::vector<LongRegion> all_;
  std::vector<std::uint32_t> index_of_;  ///< by region. It is empty if there is no long one
};

}  // namespace graze
