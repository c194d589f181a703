#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <limits>
#include <span>
#include <vector>

namespace graze::tools {

/// Divides regions of a mesh by the distance along its edges at rest, within the region: vertices that are
/// near each other in space alone are not kept together.
class SurfaceHalves {
 public:
  explicit SurfaceHalves(const Mesh& mesh);

  /// Sorts a region's vertices so that the first so many, as returned, are one half. A connected region is
  /// divided in the middle between two of its ends that are far from each other. Of one that is not
  /// connected, whole components go to either half.
  std::size_t sort(std::span<std::uint32_t> region);

 private:
  static constexpr double unreached = std::numeric_limits<double>::infinity();

  std::size_t sort_components(std::span<std::uint32_t> region);
  void measure_from(std::uint32_t start, std::vector<double>& distances);
  [[nodiscard]] std::uint32_t furthest(std::span<const std::uint32_t> region) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> region_of_;  ///< of each vertex, which call of `sort` was the last about it
  std::uint32_t region_ = 0;
  std::vector<double> distance_;  ///< of each vertex, in the region
  std::vector<double> from_other_end_;
};

}  // namespace graze::tools
