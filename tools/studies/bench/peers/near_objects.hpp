#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/peers/simd.hpp"
#include "bench/peers/workers.hpp"
#include "bench/scenes/world.hpp"

namespace graze::bench {

struct ObjectPair {
  std::uint32_t a, b;  ///< a < b
};

/// The first work of every peer in a frame. It computes a box for each object that has changed, and the pairs
/// of objects whose boxes are within the distance.
class NearObjects {
 public:
  NearObjects(const World& world, Workers& workers);

  void update();

  [[nodiscard]] const FloatBox& box(std::uint32_t object) const { return boxes_[object]; }
  [[nodiscard]] std::span<const ObjectPair> pairs() const { return pairs_; }
  /// The objects that are in any pair, in ascending order.
  [[nodiscard]] std::span<const std::uint32_t> objects() const { return near_; }

 private:
  void update_boxes();
  void sort_into_cells();
  void find_pairs_of(std::size_t place);

  const World& world_;
  Workers& workers_;
  std::vector<std::uint64_t> versions_;  ///< of the boxes
  std::vector<FloatBox> boxes_;
  std::vector<FloatBox> grown_;
  // A grid whose cells are as large as the largest box, row after row of cells along x.
  float corner_[3] = {};
  float cell_ = 0;
  std::uint32_t cells_[3] = {};
  std::vector<std::uint32_t> cell_of_;
  std::vector<std::uint32_t> cell_begin_;
  std::vector<std::uint32_t> sorted_;  ///< objects by cell
  std::vector<ObjectPair> pairs_;
  std::vector<std::uint32_t> near_;
  std::vector<char> is_near_;
};

}  // namespace graze::bench
