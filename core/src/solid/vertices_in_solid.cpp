#include "solid/vertices_in_solid.hpp"

#include <algorithm>

#include "leaves/touching_edges.hpp"
#include "solid/point_in_solid.hpp"
#include "surface/region_visit.hpp"

namespace graze {
namespace {

/// An edge by its ends, the lower one first.
std::uint64_t number_of(std::uint32_t vertex, std::uint32_t other) {
  const auto [low, high] = std::minmax(vertex, other);
  return std::uint64_t{low} << 32U | high;
}

}  // namespace

void VerticesInSolid::find(const Surface& surface, const Surface& solid,
                           std::span<const std::uint32_t> touching, DecisionCount& count) {
  begin(surface);
  list_candidates(surface, solid.box());
  if (candidates_.empty()) return;
  list_touching(surface.mesh(), touching);
  for (const std::uint32_t first : candidates_) {
    if (states_[first] != State::candidate) continue;
    if (!join(surface.mesh(), first)) continue;
    const PointInSolid location = locate(surface.position(first), solid, count);
    // All edges of a vertex on the surface touch it, so it is not joined with others.
    if (location == PointInSolid::on_surface) states_[first] = State::on_surface;
    if (location != PointInSolid::inside && location != PointInSolid::inside_out) continue;
    has_inside_out_ = has_inside_out_ || location == PointInSolid::inside_out;
    for (const std::uint32_t vertex : joined_) states_[vertex] = State::inside;
  }
  for (const std::uint32_t vertex : candidates_)
    if (states_[vertex] == State::inside) inside_.push_back(vertex);
  for (const std::uint64_t edge : touching_) beside_[edge >> 32U] = beside_[edge & ~std::uint32_t{0}] = 0;
}

void VerticesInSolid::set_none(const Surface& surface) {
  begin(surface);
}

void VerticesInSolid::set_all(const Surface& surface) {
  begin(surface);
  const auto vertices = surface.mesh().regions().vertices();
  inside_.assign(vertices.begin(), vertices.end());
  for (const std::uint32_t vertex : inside_) states_[vertex] = State::inside;
}

/// Forgets what it found before, and makes room.
void VerticesInSolid::begin(const Surface& surface) {
  for (const auto* const vertices : {&candidates_, &inside_})
    for (const std::uint32_t vertex : *vertices) states_[vertex] = State::outside;
  candidates_.clear();
  inside_.clear();
  has_inside_out_ = false;
  const std::size_t count = surface.mesh().vertex_count();
  if (states_.size() < count) states_.resize(count, State::outside);
  if (beside_.size() < count) beside_.resize(count, 0);
}

void VerticesInSolid::list_candidates(const Surface& surface, const Box& box) {
  visit_leaves(
      surface, [&](const Box& region) { return !common(region, box).empty(); },
      [&](const Region& leaf) {
        for (const std::uint32_t vertex : surface.mesh().regions().vertices(leaf)) {
          if (!graze::contains(box, surface.position(vertex))) continue;
          states_[vertex] = State::candidate;
          candidates_.push_back(vertex);
        }
      });
}

void VerticesInSolid::list_touching(const IndexedMesh& mesh, std::span<const std::uint32_t> touching) {
  touching_.clear();
  for (const std::uint32_t edge : touching) {
    const auto [first, second] = mesh.edge(edge);
    touching_.push_back(number_of(first, second));
    beside_[first] = beside_[second] = 1;
  }
  std::sort(touching_.begin(), touching_.end());
}

/// Gathers the candidates that are joined with one. Returns false if they are joined with a vertex that is no
/// candidate, and so outside.
bool VerticesInSolid::join(const IndexedMesh& mesh, std::uint32_t first) {
  joined_.assign(1, first);
  states_[first] = State::joined;
  bool is_apart = true;
  for (std::size_t i = 0; i < joined_.size(); ++i)
    for (const std::uint32_t other : mesh.vertex_neighbours(joined_[i])) {
      if (states_[other] == State::joined || !is_joined(joined_[i], other)) continue;
      if (states_[other] == State::outside) is_apart = false;
      if (states_[other] != State::candidate) continue;
      states_[other] = State::joined;
      joined_.push_back(other);
    }
  return is_apart;
}

/// Whether the edge of two vertices does not touch the solid's surface.
bool VerticesInSolid::is_joined(std::uint32_t vertex, std::uint32_t other) const {
  return beside_[vertex] == 0 || beside_[other] == 0 ||
         !std::binary_search(touching_.begin(), touching_.end(), number_of(vertex, other));
}

void VerticesInSolid::reserve(const PairRoom& room) {
  states_.reserve(room.vertices);
  beside_.reserve(room.vertices);
  for (auto* const vertices : {&candidates_, &joined_, &inside_}) vertices->reserve(room.vertices);
  touching_.reserve(TouchingEdges::reserved);
}

}  // namespace graze
