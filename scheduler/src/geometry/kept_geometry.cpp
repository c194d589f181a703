#include "geometry/kept_geometry.hpp"

#include <algorithm>

#include "core/base/bytes_of.hpp"

namespace graze {

void KeptGeometry::fill(std::vector<KeptObject>& objects, std::span<const std::uint32_t> order) {
  objects_.swap(objects);
  std::fill(index_of_slot_.begin(), index_of_slot_.end(), no_slot);
  for (std::size_t index = 0; index < objects_.size(); ++index) {
    const std::uint32_t slot = objects_[index].id.index;
    if (slot >= index_of_slot_.size()) index_of_slot_.resize(slot + std::size_t{1}, no_slot);
    index_of_slot_[slot] = static_cast<std::uint32_t>(index);
  }
  object_of_leaf_.assign(order.begin(), order.end());
  level_count_ = 0;
  const auto add_level = [&](std::size_t size) -> std::vector<Box>& {
    if (levels_.size() == level_count_) levels_.emplace_back();
    std::vector<Box>& level = levels_[level_count_++];
    level.assign(size, Box{});
    return level;
  };
  std::vector<Box>& leaves = add_level(order.size());
  for (std::size_t leaf = 0; leaf < order.size(); ++leaf)
    if (order[leaf] != no_slot) leaves[leaf] = objects_[order[leaf]].surface->surface.box();
  while (levels_[level_count_ - 1].size() > 1) {
    const std::size_t below = level_count_ - 1;
    std::vector<Box>& level = add_level((levels_[below].size() + width - 1) / width);
    for (std::size_t child = 0; child < levels_[below].size(); ++child)
      if (!levels_[below][child].empty()) level[child / width].add(levels_[below][child]);
  }
}

const KeptObject* KeptGeometry::find(ObjectId id) const {
  if (id.index >= index_of_slot_.size() || index_of_slot_[id.index] == no_slot) return nullptr;
  const KeptObject& object = objects_[index_of_slot_[id.index]];
  return object.id == id ? &object : nullptr;
}

std::size_t KeptGeometry::byte_count() const {
  std::size_t bytes = sizeof(KeptGeometry) + bytes_of(objects_) + bytes_of(index_of_slot_) +
                      bytes_of(object_of_leaf_) + bytes_of(levels_);
  for (const std::vector<Box>& level : levels_) bytes += bytes_of(level);
  return bytes;
}

}  // namespace graze
