#include "local_vertices.hpp"

#include "listed_vertices.hpp"

namespace graze {

void LocalVertices::begin(std::size_t count) {
  stride_ = stride_of(count);
  if (data_.size() < 3 * stride_) data_.resize(3 * stride_);
  vertices_.clear();
}

Box LocalVertices::take(const Surface& surface, std::span<const std::uint32_t> vertices,
                        const FilterFrame& frame) {
  begin(vertices.size());
  vertices_.assign(vertices.begin(), vertices.end());
  return bring_in_rows(surface, vertices, frame, {data_.data(), stride_});
}

void LocalVertices::take(const LocalVertices& all, std::span<const std::uint32_t> places) {
  begin(places.size());
  kernels::filter().gather(all.block(), 3, places.data(), places.size(), data_.data(), stride_);
  vertices_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) vertices_[i] = all.vertices_[places[i]];
}

void LocalVertices::reserve(std::size_t most) {
  if (data_.size() < 3 * stride_of(most)) data_.resize(3 * stride_of(most));
  vertices_.reserve(most);
}

}  // namespace graze
