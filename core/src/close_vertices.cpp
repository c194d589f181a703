#include "close_vertices.hpp"

#include <utility>

namespace graze {

void CloseVerticesScratch::make_room(std::size_t of_leaf, std::size_t beside) {
  const auto make = [](std::size_t count, auto&... lists) {
    ((lists.size() < count ? lists.resize(count) : void()), ...);
  };
  make(of_leaf, found_a, first, last);
  make(std::max(beside, most_beside), found_b);
  make(std::max({beside, most_beside, most_pairs}), near_row, near);
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
  std::fill_n(scratch_.first.begin(), rows, 0U);
  std::fill_n(scratch_.last.begin(), rows, static_cast<std::uint32_t>(points));
  // What is not nearer in float is certainly not nearer than the limit.
  const float reach = frame.to_local_limit(limit_) + 2 * frame.to_local(box_).size * kernels::margin;
  const std::size_t rows_at_once = std::max<std::size_t>(CloseVerticesScratch::most_pairs / points, 1);
  for (std::size_t row = 0; row < rows; row += rows_at_once)
    compare_rows(row, std::min(rows, row + rows_at_once), reach);
}

void CloseVertices::compare_rows(std::size_t begin, std::size_t end, float reach) {
  const std::size_t found = kernels::filter().near_rows(
      scratch_.a.block(), begin, end, scratch_.b.block(), scratch_.first.data(), scratch_.last.data(),
      reach * reach, {scratch_.near_row.data(), scratch_.near.data()});
  pair_.count.discarded_in_float += (end - begin) * scratch_.b.count() - found;
  for (std::size_t k = 0; k < found; ++k) {
    const ContactName name = ContactName::of(vertex_piece(scratch_.a.vertex(scratch_.near_row[k])),
                                             vertex_piece(scratch_.b.vertex(scratch_.near[k])));
    if (is_closer_than(pair_, name, limit_)) names_.push_back(name);
  }
}

}  // namespace graze
