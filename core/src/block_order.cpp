#include "block_order.hpp"

#include <algorithm>
#include <graze/box.hpp>
#include <graze/vertex_blocks.hpp>
#include <span>
#include <tuple>

namespace graze {
namespace {

/// Halves vertices along the longest side of their box until what is left is one block: whole blocks on
/// either side, and ties by number, so that the order is that of the positions alone.
void halve(const Mesh& mesh, std::span<std::uint32_t> vertices) {
  constexpr std::size_t size = VertexBlocks::block_size;
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

std::vector<std::uint32_t> block_order_of(const Mesh& mesh) {
  const auto used = mesh.regions().vertices(mesh.regions().region(0));
  std::vector<std::uint32_t> order(used.begin(), used.end());
  halve(mesh, order);
  return order;
}

}  // namespace graze
