#include "core/surface/surface_part.hpp"

#include <algorithm>
#include <utility>

#include "base/limits.hpp"
#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// The place of all vertices that are not there. No position that a surface takes is as far out. Squares of
/// its distances are finite in double.
Eigen::Vector3d beyond_reach() {
  return Eigen::Vector3d::Constant(8 * largest_coordinate);
}

Box box_beyond_reach() {
  return {beyond_reach(), beyond_reach()};
}

bool is_within_reach(const Box& box) {
  return box.min.x() <= largest_coordinate;
}

}  // namespace

SurfacePart::SurfacePart(std::shared_ptr<const Mesh> mesh) : surface_(std::move(mesh)) {}

void SurfacePart::take(const Surface& from, std::span<const std::uint32_t> leaves) {
  clear(from.positions().is_double());
  const RegionTree& tree = surface_.mesh().regions();
  leaves_.assign(leaves.begin(), leaves.end());
  surface_.box_ = {};
  for (const std::uint32_t leaf : leaves_) {
    const Region& region = tree.region(leaf);
    copy_around(from, tree.vertices(region));
    copy_around(from, tree.border(region));
    box_leaf(leaf);
  }
  box_long_regions();
  begin_version();
}

void SurfacePart::take_all(const Surface& from) {
  leaves_.clear();
  inner_.clear();
  vertices_.clear();
  has_all_ = true;
  surface_.copy_refitted(from);
}

/// Puts everything out of reach, in a precision.
void SurfacePart::clear(bool in_double) {
  const bool is_new = !surface_.has_own_positions() || surface_.positions().is_double() != in_double;
  if (std::exchange(has_all_, false) || is_new) {
    surface_.own_positions(in_double);
    clear_all();
    return;
  }
  for (const std::uint32_t vertex : vertices_)
    in_double ? void(surface_.in_double_[vertex] = beyond_reach())
              : void(surface_.in_float_[vertex] = beyond_reach().cast<float>());
  for (const std::uint32_t leaf : leaves_) surface_.face_boxes_[leaf] = box_beyond_reach();
  for (const std::uint32_t region : inner_) surface_.face_boxes_[region] = box_beyond_reach();
  inner_.clear();
  vertices_.clear();
}

void SurfacePart::clear_all() {
  surface_.pose_.reset();
  std::fill(surface_.in_double_.begin(), surface_.in_double_.end(), beyond_reach());
  std::fill(surface_.in_float_.begin(), surface_.in_float_.end(), beyond_reach().cast<float>());
  surface_.begin_refit(RefitOf::faces);
  std::fill(surface_.face_boxes_.begin(), surface_.face_boxes_.end(), box_beyond_reach());
  inner_.clear();
  vertices_.clear();
}

/// Copies vertices, and the corners of all faces around them.
void SurfacePart::copy_around(const Surface& from, std::span<const std::uint32_t> vertices) {
  const IndexedMesh& mesh = surface_.mesh();
  const PositionView positions = from.positions();
  for (const std::uint32_t vertex : vertices)
    for (const std::uint32_t face : mesh.vertex_faces(vertex))
      for (const std::uint32_t corner : mesh.face(face)) copy(positions, corner);
}

void SurfacePart::copy(const PositionView& positions, std::uint32_t vertex) {
  if (surface_.position(vertex).x() <= largest_coordinate) return;  // it is there
  vertices_.push_back(vertex);
  positions.is_double() ? void(surface_.in_double_[vertex] = positions[vertex])
                        : void(surface_.in_float_[vertex] = positions[vertex].cast<float>());
}

/// Makes the box of a leaf, and makes those of the regions that contain it large enough.
void SurfacePart::box_leaf(std::uint32_t leaf) {
  const RegionTree& tree = surface_.mesh().regions();
  std::vector<Box>& boxes = surface_.face_boxes_;
  const Box box = boxes[leaf] = surface_.box_now(tree.region(leaf), RefitOf::faces);
  surface_.box_.add(box);
  for (std::uint32_t region = leaf; region != tree.region(region).parent;) {
    region = tree.region(region).parent;
    if (is_within_reach(boxes[region])) {
      boxes[region].add(box);
      continue;
    }
    boxes[region] = box;
    inner_.push_back(region);
  }
}

/// Long leaves that are there have boxes along their faces. For the regions that contain them the boxes
/// along the axes have to do. All others keep what they had, since their other boxes are out of reach.
void SurfacePart::box_long_regions() {
  const LongRegions& all = surface_.mesh().long_regions();
  if (all.empty()) return;
  for (const std::uint32_t leaf : leaves_)
    if (const std::uint32_t index = all.index_of(leaf); index != LongRegions::none)
      surface_.oriented_boxes_[index] = surface_.oriented_box_now(all.all()[index]);
  for (const std::uint32_t region : inner_)
    if (const std::uint32_t index = all.index_of(region); index != LongRegions::none)
      surface_.oriented_boxes_[index] = OrientedBox::of(surface_.face_boxes_[region]);
}

/// Begins a version to which nothing of the versions before applies.
void SurfacePart::begin_version() {
  ++surface_.version_;
  surface_.travel_ = {surface_.travel_.epoch + 1, 0};
  surface_.refits_[static_cast<std::size_t>(RefitOf::faces)] = {surface_.version_, surface_.travel_};
}

std::size_t SurfacePart::byte_count() const {
  return surface_.byte_count() + bytes_of(leaves_) + bytes_of(inner_) + bytes_of(vertices_);
}

}  // namespace graze
