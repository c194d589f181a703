#include "experiment/regions/partitions/surface_halves.hpp"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

namespace graze::tools {

SurfaceHalves::SurfaceHalves(const Mesh& mesh)
    : mesh_(mesh),
      region_of_(mesh.vertex_count(), 0),
      distance_(mesh.vertex_count(), unreached),
      from_other_end_(mesh.vertex_count(), unreached) {}

std::size_t SurfaceHalves::sort(std::span<std::uint32_t> region) {
  ++region_;
  for (const std::uint32_t vertex : region) {
    region_of_[vertex] = region_;
    distance_[vertex] = unreached;
    from_other_end_[vertex] = unreached;
  }
  measure_from(region.front(), distance_);
  const std::uint32_t one_end = furthest(region);
  if (distance_[one_end] == unreached) return sort_components(region);
  for (const std::uint32_t vertex : region) distance_[vertex] = unreached;
  measure_from(one_end, distance_);
  measure_from(furthest(region), from_other_end_);
  std::sort(region.begin(), region.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(distance_[a] - from_other_end_[a], a) < std::pair(distance_[b] - from_other_end_[b], b);
  });
  return region.size() / 2;
}

/// The largest component first, each to the half that is smaller so far.
std::size_t SurfaceHalves::sort_components(std::span<std::uint32_t> region) {
  struct Component {
    std::uint32_t first;
    std::vector<std::uint32_t> vertices;
  };
  std::vector<Component> components;
  std::sort(region.begin(), region.end());
  for (const std::uint32_t start : region) {
    if (region_of_[start] != region_) continue;
    Component component{start, {start}};
    region_of_[start] = 0;
    for (std::size_t i = 0; i < component.vertices.size(); ++i)
      for (const std::uint32_t next : mesh_.vertex_neighbours(component.vertices[i]))
        if (region_of_[next] == region_) {
          region_of_[next] = 0;
          component.vertices.push_back(next);
        }
    components.push_back(std::move(component));
  }
  std::sort(components.begin(), components.end(), [](const Component& a, const Component& b) {
    return std::pair(b.vertices.size(), a.first) < std::pair(a.vertices.size(), b.first);
  });
  std::vector<std::uint32_t> left, right;
  for (const Component& component : components) {
    std::vector<std::uint32_t>& smaller = left.size() <= right.size() ? left : right;
    smaller.insert(smaller.end(), component.vertices.begin(), component.vertices.end());
  }
  std::copy(right.begin(), right.end(), std::copy(left.begin(), left.end(), region.begin()));
  return left.size();
}

/// Dijkstra's algorithm over the region's own edges.
void SurfaceHalves::measure_from(std::uint32_t start, std::vector<double>& distances) {
  using Reached = std::pair<double, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  distances[start] = 0;
  open.emplace(0, start);
  while (!open.empty()) {
    const auto [distance, vertex] = open.top();
    open.pop();
    if (distance > distances[vertex]) continue;
    for (const std::uint32_t next : mesh_.vertex_neighbours(vertex)) {
      if (region_of_[next] != region_) continue;
      const double there = distance + (mesh_.rest()[next] - mesh_.rest()[vertex]).norm();
      if (there < distances[next]) {
        distances[next] = there;
        open.emplace(there, next);
      }
    }
  }
}

std::uint32_t SurfaceHalves::furthest(std::span<const std::uint32_t> region) const {
  return *std::max_element(region.begin(), region.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(distance_[a], a) < std::pair(distance_[b], b);
  });
}

}  // namespace graze::tools
