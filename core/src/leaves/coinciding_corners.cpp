#include "leaves/coinciding_corners.hpp"

#include <algorithm>
#include <bit>

namespace graze {
namespace {

/// Numbers of corners of b begin here, so that they differ from those of a.
constexpr std::uint32_t first_of_b = std::uint32_t{1} << 31U;

/// Its upper bits depend on all of a position. Adding 0 makes -0 into 0.
std::uint64_t hash_of(const Eigen::Vector3d& point) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 / the golden ratio
  std::uint64_t hash = 0;
  for (const double coordinate : point) hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * odd;
  return hash;
}

}  // namespace

void CoincidingCorners::Side::begin(const Surface& surface, const Region& leaf) {
  const RegionTree& tree = surface.mesh().regions();
  edge_ends = tree.edge_ends(leaf);
  triangle_corners = tree.triangle_corners(leaf);
  has_quads = triangle_corners.size() != 3 * std::size_t{leaf.face_count};
  const auto own = tree.vertices(leaf);
  const auto border = tree.border(leaf);
  vertex.assign(own.begin(), own.end());
  vertex.insert(vertex.end(), border.begin(), border.end());
  point.resize(vertex.size());
  for (std::size_t i = 0; i < vertex.size(); ++i) point[i] = surface.position(vertex[i]);
}

/// Returns the slot of the corner of a that is at a position, or where it would be.
std::uint32_t& CoincidingCorners::slot_of(const Eigen::Vector3d& point) {
  const int bits = std::countr_zero(slots_.size());
  auto slot = static_cast<std::size_t>(hash_of(point) >> (64 - bits));
  while (slots_[slot] != none && a_.point[slots_[slot]] != point) slot = (slot + 1) & (slots_.size() - 1);
  return slots_[slot];
}

void CoincidingCorners::begin(const SurfacePair& pair, const Region& leaf_a, const Region& leaf_b) {
  a_.begin(pair.a, leaf_a);
  b_.begin(pair.b, leaf_b);
  slots_.assign(std::bit_ceil(std::max<std::size_t>(2 * a_.vertex.size(), 2)), none);
  a_.position.resize(a_.vertex.size());
  for (std::uint32_t i = 0; i < a_.vertex.size(); ++i) {
    std::uint32_t& slot = slot_of(a_.point[i]);
    if (slot == none) slot = i;
    a_.position[i] = slot;
  }
  b_.position.resize(b_.vertex.size());
  any_ = false;
  for (std::uint32_t i = 0; i < b_.vertex.size(); ++i) {
    const std::uint32_t at = slot_of(b_.point[i]);
    b_.position[i] = at == none ? first_of_b + i : at;
    any_ = any_ || at != none;
  }
  if (any_) a_.offered.assign(a_.vertex.size(), none);
}

void CoincidingCorners::reserve(const PairRoom& room) {
  // An edge and a face have a corner of the leaf's own.
  const std::size_t corners = room.leaf_vertices + room.leaf_edges + 3 * room.leaf_faces;
  for (Side* const side : {&a_, &b_}) {
    side->vertex.reserve(corners);
    side->point.reserve(corners);
    side->position.reserve(corners);
    side->offered.reserve(corners);
  }
  slots_.reserve(std::bit_ceil(2 * corners + 2));
}

}  // namespace graze
