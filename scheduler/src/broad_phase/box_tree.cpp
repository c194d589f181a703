#include "broad_phase/box_tree.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

/// The number of nodes that one task refits, or of leaves that one task fills.
constexpr std::size_t boxes_of_slice = 512;

/// About how long a box takes on one thread, where it is taken up and where it is joined with others.
constexpr double nanoseconds_each_box = 10;

constexpr std::size_t slices_of(std::size_t count) {
  return (count + boxes_of_slice - 1) / boxes_of_slice;
}

}  // namespace

const BoxTree::Limits BoxTree::no_box = {infinity, infinity, infinity, infinity, infinity, infinity};

BoxTree::Limits BoxTree::limits_of(const Box& box) {
  Limits limits;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<Eigen::Index>(axis);
    limits[axis] = std::clamp(box.min[index], -largest, largest);
    limits[axis + 3] = std::clamp(-box.max[index], -largest, largest);
  }
  return limits;
}

BoxTree::Reach BoxTree::reach_of(const Limits& limits) {
  return {-limits[3], -limits[4], -limits[5], -limits[0], -limits[1], -limits[2]};
}

/// Bit i says whether box i meets. There is no branch for each number, since its outcome cannot be predicted.
unsigned BoxTree::meeting(const Limits* eight, const Reach& reach) {
  unsigned meeting = 0;
  for (unsigned i = 0; i < width; ++i) {
    const Limits& box = eight[i];
    unsigned apart = 0;
    for (std::size_t side = 0; side < box.size(); ++side) apart |= box[side] > reach[side] ? 1U : 0U;
    meeting |= (apart ^ 1U) << i;
  }
  return meeting;
}

/// Resizes the levels to the number of leaves. New nodes are empty.
void BoxTree::make_levels() {
  std::size_t nodes = slot_of_.size();
  level_count_ = 0;
  while (true) {
    if (levels_.size() <= level_count_) levels_.emplace_back();
    levels_[level_count_++].resize((nodes + width - 1) / width * width, no_box);
    if (nodes <= 1) return;
    nodes = (nodes + width - 1) / width;
  }
}

void BoxTree::build(std::span<const Box> boxes, TaskPool& tasks) {
  order_.make(boxes, slot_of_, tasks);
  filters_are_current_ = false;
  ordered_ = slot_of_.size();
  leaf_of_.resize(boxes.size());
  for (std::uint32_t leaf = 0; leaf < slot_of_.size(); ++leaf)
    if (slot_of_[leaf] != no_slot) leaf_of_[slot_of_[leaf]] = leaf;
  find_end();
  for (auto& level : levels_) level.clear();
  make_levels();
  move_all(boxes, tasks);
  ordered_sides_.resize(block_count());
  for (std::size_t block = 0; block < ordered_sides_.size(); ++block)
    ordered_sides_[block] = side_of_block(block);
}

double BoxTree::side_of_block(std::size_t block) const {
  const Limits& box = levels_[1][block];
  return std::max({-box[3] - box[0], -box[4] - box[1], -box[5] - box[2]});
}

std::size_t BoxTree::widened_blocks() const {
  std::size_t widened = 0;
  for (std::size_t block = 0; block < ordered_sides_.size(); ++block)
    widened += side_of_block(block) > 2 * ordered_sides_[block] ? 1U : 0U;
  return widened;
}

void BoxTree::move_all(std::span<const Box> boxes, TaskPool& tasks) {
  const auto fill = [&](unsigned, std::size_t index) {
    const std::size_t end = std::min((index + 1) * boxes_of_slice, slot_of_.size());
    for (std::size_t leaf = index * boxes_of_slice; leaf < end; ++leaf)
      levels_[0][leaf] = slot_of_[leaf] == no_slot ? no_box : limits_of(boxes[slot_of_[leaf]]);
  };
  tasks.run(slices_of(slot_of_.size()), std::ref(fill),
            {.nanoseconds = nanoseconds_each_box * static_cast<double>(slot_of_.size())});
  refit_all(tasks);
}

void BoxTree::refit_all(TaskPool& tasks) {
  for (std::uint32_t level = 1; level < level_count_; ++level) {
    const std::size_t count = (levels_[level - 1].size()) / width;
    const auto refit = [&](unsigned, std::size_t index) {
      const std::size_t end = std::min((index + 1) * boxes_of_slice, count);
      for (std::size_t node = index * boxes_of_slice; node < end; ++node)
        refit_node(level, static_cast<std::uint32_t>(node));
    };
    tasks.run(slices_of(count), std::ref(refit),
              {.nanoseconds = nanoseconds_each_box * static_cast<double>(levels_[level - 1].size())});
  }
}

void BoxTree::refit_node(std::uint32_t level, std::uint32_t index) {
  const Limits* const children = &levels_[level - 1][std::size_t{index} * width];
  Limits box = children[0];
  for (std::size_t child = 1; child < width; ++child)
    for (std::size_t side = 0; side < box.size(); ++side)
      box[side] = std::min(box[side], children[child][side]);
  levels_[level][index] = box;
}

/// Sets the box of a leaf and updates its ancestors.
void BoxTree::put(std::uint32_t leaf, const Box& box) {
  levels_[0][leaf] = slot_of_[leaf] == no_slot ? no_box : limits_of(box);
  std::uint32_t index = leaf;
  for (std::uint32_t level = 1; level < level_count_; ++level) {
    index /= width;
    const Limits before = levels_[level][index];
    refit_node(level, index);
    if (levels_[level][index] == before) return;
  }
}

void BoxTree::move(std::uint32_t slot, const Box& box) {
  put(leaf_of_[slot], box);
}

void BoxTree::add(std::uint32_t slot, const Box& box) {
  filters_are_current_ = false;
  const std::uint32_t leaf = end_++;
  if (leaf == slot_of_.size()) {
    const std::size_t levels_before = level_count_;
    slot_of_.resize(slot_of_.size() + width, no_slot);
    make_levels();
    // A new root contains all that the last one contained.
    for (std::size_t level = std::max<std::size_t>(levels_before, 1); level < level_count_; ++level)
      refit_node(static_cast<std::uint32_t>(level), 0);
  }
  slot_of_[leaf] = slot;
  if (slot == leaf_of_.size()) leaf_of_.emplace_back();
  leaf_of_[slot] = leaf;
  put(leaf, box);
}

void BoxTree::rename(std::span<const std::uint32_t> new_slots, std::size_t count) {
  filters_are_current_ = false;
  for (std::uint32_t slot = 0; slot < new_slots.size(); ++slot) {
    const std::uint32_t leaf = leaf_of_[slot];
    slot_of_[leaf] = new_slots[slot];
    if (new_slots[slot] == no_slot) put(leaf, {});
  }
  renumber(leaf_of_, new_slots, count);
  find_end();
}

void BoxTree::find_end() {
  end_ = static_cast<std::uint32_t>(slot_of_.size());
  while (end_ > 0 && slot_of_[end_ - 1] == no_slot) --end_;
}

void BoxTree::prepare_filters(const FilterClasses& classes) {
  classes_ = classes.filters_some() ? &classes : nullptr;
  if (classes_ == nullptr || filters_are_current_) return;
  filters_.resize(std::max(filters_.size(), level_count_));
  filters_[0].resize(levels_[0].size());
  for (std::size_t leaf = 0; leaf < slot_of_.size(); ++leaf)
    filters_[0][leaf] = slot_of_[leaf] == no_slot ? NodeFilter() : classes.filter_of(slot_of_[leaf]);
  for (std::size_t level = 1; level < level_count_; ++level) {
    filters_[level].assign(levels_[level].size(), {});
    for (std::size_t child = 0; child < filters_[level - 1].size(); ++child)
      filters_[level][child / width].add(filters_[level - 1][child]);
  }
  filters_are_current_ = true;
}

unsigned BoxTree::passing(unsigned met, std::uint32_t level, std::uint32_t first,
                          const WantedFilter& wanted) const {
  if (classes_ == nullptr) return met;
  unsigned passing = 0;
  for (unsigned left = met; left != 0; left &= left - 1)
    if (wanted.may_touch(filters_[level][first + static_cast<std::uint32_t>(std::countr_zero(left))]))
      passing |= left & -left;
  return passing;
}

std::uint64_t BoxTree::find(std::uint32_t slot, const Box& box, std::vector<std::uint32_t>& found) const {
  if (slot_of_.empty()) return 0;
  const Reach reach = reach_of(limits_of(box));
  const WantedFilter wanted = wanted_by(0, leaf_of_[slot]);
  std::uint64_t tested = 0;
  Stack stack;
  std::size_t height = 0;
  stack[height++] = {static_cast<std::uint32_t>(level_count_ - 1), 0};
  while (height > 0) {
    const Node node = stack[--height];
    const std::uint32_t first = node.index * width;
    tested += width;
    unsigned left = passing(meeting(&levels_[node.level - 1][first], reach), node.level - 1, first, wanted);
    for (; left != 0; left &= left - 1) {
      const std::uint32_t child = first + static_cast<std::uint32_t>(std::countr_zero(left));
      if (node.level == 1)
        found.push_back(slot_of_[child]);
      else
        stack[height++] = {node.level - 1, child};
    }
  }
  return tested;
}

std::uint64_t BoxTree::find_pairs(std::uint32_t first_block, std::uint32_t last_block,
                                  std::vector<SlotPair>& found) const {
  std::uint64_t tested = 0;
  for (std::uint32_t block = first_block; block < last_block; ++block) tested += find_pairs_of(block, found);
  return tested;
}

/// Finds the blocks from this one on that meet it, and the pairs of slots in them.
std::uint64_t BoxTree::find_pairs_of(std::uint32_t block, std::vector<SlotPair>& found) const {
  const Reach reach = reach_of(levels_[1][block]);
  const WantedFilter wanted = wanted_by(1, block);
  std::uint64_t tested = 0;
  if (classes_ == nullptr || wanted.may_touch(filters_[1][block]))
    tested = find_pairs_of(block, block, found);
  Stack stack;
  std::size_t height = 0;
  const auto top = static_cast<std::uint32_t>(level_count_ - 1);
  if (top >= 2) stack[height++] = {top, 0};
  while (height > 0) {
    const Node node = stack[--height];
    const std::uint32_t first = node.index * width;
    // Children that end before this block begins have found their pairs with this block themselves.
    const std::uint32_t own = block >> (3 * (node.level - 2));
    const unsigned earlier = own <= first ? 0 : std::min(own - first, width);
    tested += width;
    unsigned left = meeting(&levels_[node.level - 1][first], reach) >> earlier << earlier;
    left = passing(left, node.level - 1, first, wanted);
    for (; left != 0; left &= left - 1) {
      const std::uint32_t child = first + static_cast<std::uint32_t>(std::countr_zero(left));
      if (node.level > 2)
        stack[height++] = {node.level - 1, child};
      else if (child != block)
        tested += find_pairs_of(block, child, found);
    }
  }
  return tested;
}

std::uint64_t BoxTree::find_pairs_of(std::uint32_t block, std::uint32_t other,
                                     std::vector<SlotPair>& found) const {
  const Limits* const ones = &levels_[0][std::size_t{block} * width];
  const Limits* const others = &levels_[0][std::size_t{other} * width];
  std::uint64_t tested = width;
  for (unsigned left = meeting(ones, reach_of(levels_[1][other])); left != 0; left &= left - 1) {
    const auto one = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t slot = slot_of_[block * width + one];
    unsigned meets = meeting(others, reach_of(ones[one]));
    if (block == other) meets &= ~1U << one;  // only those behind it
    if (meets != 0) meets = passing(meets, 0, other * width, wanted_by(0, block * width + one));
    tested += width;
    for (; meets != 0; meets &= meets - 1)
      found.push_back(
          pair_of(slot, slot_of_[other * width + static_cast<std::uint32_t>(std::countr_zero(meets))]));
  }
  return tested;
}

void BoxTree::reserve(std::size_t boxes, std::size_t leaves) {
  order_.reserve(boxes, leaves);
  leaf_of_.reserve(boxes);
  slot_of_.reserve(leaves);
  ordered_sides_.reserve(leaves / width + 1);
  std::size_t nodes = leaves;
  for (std::size_t level = 0;; ++level, nodes = (nodes + width - 1) / width) {
    if (levels_.size() <= level) levels_.emplace_back();
    levels_[level].reserve((nodes + width - 1) / width * width);
    filters_.resize(std::max(filters_.size(), level + 1));
    filters_[level].reserve((nodes + width - 1) / width * width);
    if (nodes <= 1) return;
  }
}

std::size_t BoxTree::byte_count() const {
  std::size_t bytes = order_.byte_count() + bytes_of(slot_of_) + bytes_of(leaf_of_) +
                      bytes_of(ordered_sides_) + bytes_of(levels_);
  for (const auto& level : levels_) bytes += bytes_of(level);
  for (const auto& level : filters_) bytes += bytes_of(level);
  return bytes;
}

#ifdef GRAZE_VALIDATE
void BoxTree::validate(std::span<const Box> boxes) const {
  const auto require = [](bool holds, const char* what, std::size_t index) {
    if (!holds)
      throw std::logic_error(std::string("graze validator: ") + what + " at " + std::to_string(index));
  };
  require(leaf_of_.size() == boxes.size(), "a slot has no leaf", boxes.size());
  std::size_t filled = 0;
  for (const std::uint32_t slot : slot_of_) filled += slot == no_slot ? 0U : 1U;
  require(filled == boxes.size(), "a leaf is in use by no slot", filled);
  for (std::size_t slot = 0; slot < boxes.size(); ++slot) {
    require(slot_of_[leaf_of_[slot]] == slot, "a slot is in another's leaf", slot);
    require(levels_[0][leaf_of_[slot]] == limits_of(boxes[slot]), "a leaf has another box", slot);
  }
  for (std::size_t level = 1; level < level_count_; ++level)
    for (std::size_t child = 0; child < levels_[level - 1].size(); ++child)
      for (std::size_t side = 0; side < no_box.size(); ++side)
        require(levels_[level][child / width][side] <= levels_[level - 1][child][side],
                "a node does not contain a child", child);
}
#else
void BoxTree::validate(std::span<const Box>) const {}
#endif

}  // namespace graze
