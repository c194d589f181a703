#include "mesh/block_order.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "core/base/block_sizes.hpp"
#include "core/base/box.hpp"

namespace graze {
namespace {

/// Halves vertices along the longest side of their box until one block is left. Each side has whole blocks,
/// and ties go by number, so that the order depends on the positions alone.
void halve(const IndexedMesh& mesh, std::span<std::uint32_t> vertices) {
  constexpr std::size_t size = vertices_per_block;
  if (vertices.size() <= size) return std::sort(vertices.begin(), vertices.end());
  Box box;
  for (const std::uint32_t vertex : vertices) box.add(mesh.rest()[vertex]);
  int axis = 0;
  (box.max - box.min).maxCoeff(&axis);
  const std::size_t half = (vertices.size() / size + 1) / 2 * size;
  std::nth_element(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(half), vertices.end(),
                   [&](std::uint32_t left, std::uint32_t right) {
                     return std::tuple(mesh.rest()[left][axis], left) <
                            std::tuple(mesh.rest()[right][axis], right);
                   });
  halve(mesh, vertices.first(half));
  halve(mesh, vertices.subspan(half));
}

}  // namespace

std::vector<std::uint32_t> block_order_of(const IndexedMesh& mesh) {
  const auto used = mesh.regions().vertices(mesh.regions().region(0));
  std::vector<std::uint32_t> order(used.begin(), used.end());
  halve(mesh, order);
  return order;
}

void list_stretch_groups(std::span<const std::uint32_t> order, std::vector<std::uint32_t>& groups,
                         std::vector<std::uint32_t>& begin) {
  const auto count = static_cast<std::uint32_t>(order.size());
  std::vector<std::uint32_t> group_of(count);
  for (std::uint32_t position = 0; position < count; ++position)
    group_of[order[position]] = position / vertices_per_group;
  begin.push_back(0);
  for (std::uint32_t first = 0; first < count; first += vertices_per_stretch) {
    const auto stretch = std::span(group_of).subspan(first, std::min(vertices_per_stretch, count - first));
    std::sort(stretch.begin(), stretch.end());
    groups.insert(groups.end(), stretch.begin(), std::unique(stretch.begin(), stretch.end()));
    begin.push_back(static_cast<std::uint32_t>(groups.size()));
  }
}

}  // namespace graze
