#include "solid/highest_along.hpp"

#include <algorithm>
#include <limits>

#include "surface/region_visit.hpp"

namespace graze {
namespace {

/// At least the product of any point in a box with a direction, as double rounds it.
double upper_along(const Box& box, const Eigen::Vector3d& direction) {
  const Eigen::Array3d furthest = (direction.array() > 0).select(box.max, box.min);
  const Eigen::Array3d products = furthest * direction.array();
  return products.sum() + products.abs().sum() * 0x1p-50;
}

/// The child of a region whose box reaches highest, down to a leaf.
const Region& leaf_in_front(const Surface& surface, const Eigen::Vector3d& direction) {
  const RegionTree& tree = surface.mesh().regions();
  std::uint32_t number = 0;
  while (!tree.region(number).is_leaf()) {
    const Region& region = tree.region(number);
    number = region.first_child;
    for (std::uint32_t child = region.first_child + 1; child < region.first_child + region.child_count;
         ++child)
      if (upper_along(surface.face_boxes()[child], direction) >
          upper_along(surface.face_boxes()[number], direction))
        number = child;
  }
  return tree.region(number);
}

}  // namespace

double highest_along(const Surface& surface, const Eigen::Vector3d& direction) {
  double highest = -std::numeric_limits<double>::infinity();
  const auto add = [&](const Region& leaf) {
    for (const std::uint32_t vertex : surface.mesh().regions().vertices(leaf))
      highest = std::max(highest, surface.position(vertex).dot(direction));
  };
  add(leaf_in_front(surface, direction));
  visit_leaves(
      surface, [&](const Box& box) { return upper_along(box, direction) > highest; }, add);
  return highest;
}

}  // namespace graze
