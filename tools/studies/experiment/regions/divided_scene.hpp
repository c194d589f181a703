#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "experiment/regions/partitions/partitions.hpp"
#include "experiment/regions/placed_frames.hpp"

namespace graze::tools {

/// A scene under one partition.
class DividedScene {
 public:
  DividedScene(const PlacedFrames& scene, Partition partition,
               std::uint32_t capacity = RegionTree::leaf_capacity);

  [[nodiscard]] const PlacedFrames& scene() const { return scene_; }
  [[nodiscard]] const RegionHierarchy& hierarchy(std::size_t object) const { return *hierarchies_[object]; }
  [[nodiscard]] std::uint64_t region_count() const;
  [[nodiscard]] std::uint64_t leaf_count() const;
  [[nodiscard]] std::uint32_t level_count() const;
  [[nodiscard]] std::size_t byte_count() const;
  [[nodiscard]] double build_ms() const { return build_ms_; }
  /// Over all frames, the pairs of leaves that have vertices nearer than the scene's distance.
  [[nodiscard]] std::uint64_t near_leaf_pairs() const;
  /// The points of an object's regions in a frame, region after region.
  void lay_out(std::size_t object, std::size_t frame, std::vector<Eigen::Vector3d>& points) const;

 private:
  const PlacedFrames& scene_;
  std::vector<std::shared_ptr<const RegionHierarchy>> hierarchies_;  ///< of each object
  double build_ms_ = 0;                                              ///< of each mesh once
};

}  // namespace graze::tools
