#include "mesh/used_vertices.hpp"

#include <algorithm>

namespace graze::io {

UsedVertices::UsedVertices(std::span<const std::uint32_t> corners, std::size_t vertex_count) {
  constexpr std::size_t few = 8;
  if (corners.size() < vertex_count / few) {
    old_numbers_.assign(corners.begin(), corners.end());
    std::ranges::sort(old_numbers_);
    old_numbers_.erase(std::unique(old_numbers_.begin(), old_numbers_.end()), old_numbers_.end());
    return;
  }
  new_numbers_.assign(vertex_count, 0);
  for (const std::uint32_t corner : corners) new_numbers_[corner] = 1;
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (new_numbers_[vertex] == 0) continue;
    new_numbers_[vertex] = static_cast<std::uint32_t>(old_numbers_.size());
    old_numbers_.push_back(vertex);
  }
}

std::uint32_t UsedVertices::new_number(std::uint32_t vertex) const {
  if (!new_numbers_.empty()) return new_numbers_[vertex];
  return static_cast<std::uint32_t>(std::ranges::lower_bound(old_numbers_, vertex) - old_numbers_.begin());
}

}  // namespace graze::io
