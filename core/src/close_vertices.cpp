#include "close_vertices.hpp"

#include <utility>

namespace graze {

void CloseVerticesScratch::make_room(std::size_t of_leaf, std::size_t beside) {
  const std::size_t most_b = std::max(beside, most_beside);
  if (found_a.size() < of_leaf) found_a.resize(of_leaf);
  if (found_b.size() < most_b) found_b.resize(most_b);
  rows.make_room(of_leaf, most_b);
}

void CloseVerticesScratch::reserve(const PairRoom& room) {
  make_room(room.leaf_vertices, room.leaf_vertices);
  a.reserve(room.leaf_vertices);
  b.reserve(std::max(room.leaf_vertices, most_beside));
}

void CloseVertices::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  if (leaf_ != &leaf_a.region) begin(leaf_a);
  const auto vertices = pair_.b.mesh().regions().vertices(leaf_b.region);
  if (found_ + vertices.size() > CloseVerticesScratch::most_beside) compare();
  scratch_.make_room(leaf_a.region.vertex_count, vertices.size());
  found_ += inside_->find(vertices, scratch_.found_b.data() + found_);
}

void CloseVertices::begin(const LeafOf& leaf) {
  finish();
  leaf_ = &leaf.region;
  const Box reached = common(grown(leaf.box, limit_), pair_.b.box());
  inside_.emplace(pair_.b, reached);
  box_ = leaf.box;
  box_.add(reached);
}

void CloseVertices::finish() {
  if (leaf_ != nullptr) compare();
  leaf_ = nullptr;
}

/// What was found beside the leaf with those of its vertices that are near that.
void CloseVertices::compare() {
  const std::size_t points = std::exchange(found_, 0);
  if (points == 0) return;
  const FilterFrame frame(box_, box_);
  const Box box_b = scratch_.b.take(pair_.b, std::span(scratch_.found_b).first(points), frame);
  const std::size_t rows = InsideBox(pair_.a, grown(box_b, limit_))
                               .find(pair_.a.mesh().regions().vertices(*leaf_), scratch_.found_a.data());
  if (rows == 0) return;
  scratch_.a.take(pair_.a, std::span(scratch_.found_a).first(rows), frame);
  std::fill_n(scratch_.rows.first.begin(), rows, 0U);
  std::fill_n(scratch_.rows.last.begin(), rows, static_cast<std::uint32_t>(points));
  add_close_rows(pair_, limit_, {scratch_.a, scratch_.b}, reach_of(frame, box_, limit_), scratch_.rows,
                 names_);
}

}  // namespace graze
