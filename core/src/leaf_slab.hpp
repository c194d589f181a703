#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <graze/box.hpp>
#include <graze/surface.hpp>
#include <limits>
#include <vector>

#include "working_memory.hpp"

namespace graze {

/// What holds a leaf of a surface tightly where that is nearly flat: a cylinder between two planes, about the
/// leaf's middle vertex. In float, since a query keeps many.
struct LeafSlab {
  static constexpr float beyond = std::numeric_limits<float>::infinity();

  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of the planes; its length is from 1 - 2^-20 to 1
  /// At most and at least any corner's height, the product of the normal and the way from the middle vertex.
  /// Infinite where nothing is known.
  float low = -beyond;
  float high = beyond;
  float radius = beyond;  ///< at least any corner's distance from the middle vertex

  [[nodiscard]] bool is_known() const { return high < beyond; }
};

/// The slab of the corners of a leaf's features.
LeafSlab slab_of(const Surface& surface, const Region& leaf);

/// Whether what is in two slabs is certainly further apart than a distance; `between` is the way from a's
/// middle vertex to b's.
bool are_apart(const LeafSlab& a, const LeafSlab& b, const Eigen::Vector3d& between, double distance);

/// Whether slabs may say more than boxes about what is within a distance: they do not where that is as large
/// as a leaf.
inline bool are_worth_slabs(const Box& a, const Box& b, double distance) {
  const double size = std::min((a.max - a.min).maxCoeff(), (b.max - b.min).maxCoeff());
  return distance < size;
}

/// The slabs of one surface's leaves where it is now, made when asked for.
class LeafSlabs {
 public:
  /// Stays until the next call. What was made for the same positions is kept.
  const LeafSlab& of(const Surface& surface, const Region& leaf) {
    begin(surface);
    const auto number = static_cast<std::size_t>(&leaf - surface.mesh().regions().regions().data());
    if (made_in_[number] != query_) {
      made_in_[number] = query_;
      slabs_[number] = slab_of(surface, leaf);
    }
    return slabs_[number];
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.slabs_, self.made_in_);
  }
  void reserve(const PairRoom& room) {
    slabs_.reserve(room.regions);
    made_in_.reserve(room.regions);
  }

 private:
  void begin(const Surface& surface) {
    if (serial_ == surface.serial() && version_ == surface.version()) return;
    serial_ = surface.serial();
    version_ = surface.version();
    const std::size_t count = surface.mesh().regions().region_count();
    if (slabs_.size() < count) {
      slabs_.resize(count);
      made_in_.resize(count, 0);
    }
    if (++query_ == 0) {  // after 2^32 queries
      std::fill(made_in_.begin(), made_in_.end(), 0);
      query_ = 1;
    }
  }

  std::uint64_t serial_ = 0;  ///< of the surface and the positions that the slabs are of
  std::uint64_t version_ = 0;
  std::vector<LeafSlab> slabs_;
  std::vector<std::uint32_t> made_in_;  ///< in which query the slab was made
  std::uint32_t query_ = 0;
};

}  // namespace graze
