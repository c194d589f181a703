#include "core/pair/self_exclusion.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// Whether `holds(vertex of a, vertex of b)` for some vertices of two features.
template <typename Holds>
bool any_vertices(const IndexedMesh& mesh, const FeatureRef& a, const FeatureRef& b, const Holds& holds) {
  std::array<std::uint32_t, 2> room_a;
  std::array<std::uint32_t, 2> room_b;
  const auto of_b = feature_vertices(mesh, b, room_b);
  for (const std::uint32_t one : feature_vertices(mesh, a, room_a))
    for (const std::uint32_t other : of_b)
      if (holds(one, other)) return true;
  return false;
}

}  // namespace

SelfExclusion::SelfExclusion(std::shared_ptr<const IndexedMesh> mesh, std::uint32_t rings, RestGaps rest_gaps)
    : rest_(std::move(mesh)), rings_(rings), rest_gaps_(std::move(rest_gaps)) {
  rest_.mesh().prepare_for(IndexedMesh::Use::neighbours);
  rest_.mesh().prepare_for(IndexedMesh::Use::normals_of_points);
  find_far_pairs();
}

std::size_t SelfExclusion::byte_count() const {
  return sizeof(SelfExclusion) + bytes_of(rest_gaps_.of_contacts) + bytes_of(rest_gaps_.of_piercings) +
         bytes_of(rest_gaps_.boxes);
}

bool SelfExclusion::share_vertex(const FeatureRef& a, const FeatureRef& b) const {
  return any_vertices(mesh(), a, b, [](std::uint32_t one, std::uint32_t other) { return one == other; });
}

bool SelfExclusion::are_neighbours(const FeatureRef& a, const FeatureRef& b) const {
  return any_vertices(mesh(), a, b, [this](std::uint32_t one, std::uint32_t other) {
    return are_joined(one, other, rings_);
  });
}

/// Whether so many edges or fewer lead from one vertex to the other. It goes on from the vertex with fewer
/// neighbours.
bool SelfExclusion::are_joined(std::uint32_t one, std::uint32_t other, std::uint32_t edges) const {
  if (one == other) return true;
  if (edges == 0) return false;
  auto neighbours = mesh().vertex_neighbours(one);
  if (const auto of_other = mesh().vertex_neighbours(other); of_other.size() < neighbours.size()) {
    neighbours = of_other;
    other = one;
  }
  if (std::binary_search(neighbours.begin(), neighbours.end(), other)) return true;
  return edges > 1 && std::any_of(neighbours.begin(), neighbours.end(),
                                  [&](std::uint32_t next) { return are_joined(next, other, edges - 1); });
}

void SelfExclusion::find_far_pairs() {
  const auto used = mesh().regions().vertices();
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [&](std::uint32_t left, std::uint32_t right) {
      return rest_.position(left)[axis] < rest_.position(right)[axis];
    };
    const auto [least, most] = std::minmax_element(used.begin(), used.end(), along);
    far_pairs_[static_cast<std::size_t>(axis)] = {*least, mesh().vertex_faces(*most).front()};
  }
}

}  // namespace graze
