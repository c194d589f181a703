#include "broad_phase/box_order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// One thread halves ranges of more boxes than this. The smaller ranges are then halved in parallel.
constexpr std::size_t large_range = 4096;

/// The longest sides of boxes in one size class differ by a factor of at most 4.
constexpr int exponents_of_class = 2;
constexpr int lowest_exponent =
    std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
constexpr std::size_t class_count =
    static_cast<std::size_t>(std::numeric_limits<double>::max_exponent - lowest_exponent) /
        exponents_of_class +
    1;

/// Clamps a number to finite values, since boxes may be infinite.
double finite(double value) {
  constexpr double most = std::numeric_limits<double>::max() / 4;
  return std::clamp(value, -most, most);
}

/// The size class of a box. Larger boxes have lower classes.
std::uint32_t size_class_of(const Box& box) {
  double side = 0;
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, finite(box.max[axis]) - finite(box.min[axis]));
  int exponent = lowest_exponent;
  if (side > 0) std::frexp(side, &exponent);
  return static_cast<std::uint32_t>((std::numeric_limits<double>::max_exponent - exponent) /
                                    exponents_of_class);
}

/// About how long a box takes on one thread.
constexpr double nanoseconds_each_ordered = 100;

}  // namespace

void BoxOrder::make(std::span<const Box> boxes, std::vector<std::uint32_t>& leaves, TaskPool& tasks) {
  sort_by_size(boxes);
  halve_large();
  const auto halve_range = [&](unsigned, std::size_t index) { halve_down(ranges_[index]); };
  tasks.run(ranges_.size(), std::ref(halve_range),
            {.nanoseconds = nanoseconds_each_ordered * static_cast<double>(boxes.size())});
  leaves.resize(items_.size());
  std::transform(items_.begin(), items_.end(), leaves.begin(), [](const Item& item) { return item.index; });
}

void BoxOrder::sort_by_size(std::span<const Box> boxes) {
  std::array<std::size_t, class_count> counts{};
  unsorted_.clear();
  for (std::uint32_t index = 0; index < boxes.size(); ++index) {
    Item item{{}, index, size_class_of(boxes[index])};
    for (int axis = 0; axis < 3; ++axis)
      item.centre[static_cast<std::size_t>(axis)] =
          finite(boxes[index].min[axis]) + finite(boxes[index].max[axis]);
    ++counts[item.size_class];
    unsorted_.push_back(item);
  }
  std::array<std::size_t, class_count> begins{};
  std::size_t end = 0;
  ranges_.clear();
  for (std::size_t size_class = 0; size_class < class_count; ++size_class) {
    begins[size_class] = end;
    if (counts[size_class] > 0) ranges_.push_back({end, end + counts[size_class]});
    end += (counts[size_class] + block - 1) / block * block;
  }
  items_.assign(end, Item{{}, no_slot, 0});
  for (const Item& item : unsorted_) items_[begins[item.size_class]++] = item;
}

/// Splits a range in two along its widest axis and returns the first leaf of the second part. The split is at
/// the start of a group, of the largest group size that fits inside the range.
std::size_t BoxOrder::halve(const Range& range) {
  std::size_t group = block;
  while ((range.begin / (group * block) + 1) * (group * block) < range.end) group *= block;
  const std::size_t middle = std::max((range.begin + range.end) / 2 / group, range.begin / group + 1) * group;
  std::array<double, 3> low = items_[range.begin].centre;
  std::array<double, 3> high = low;
  for (std::size_t leaf = range.begin; leaf < range.end; ++leaf)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], items_[leaf].centre[axis]);
      high[axis] = std::max(high[axis], items_[leaf].centre[axis]);
    }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
  const auto at = [&](std::size_t leaf) { return items_.begin() + static_cast<std::ptrdiff_t>(leaf); };
  std::nth_element(at(range.begin), at(middle), at(range.end), [widest](const Item& left, const Item& right) {
    return left.centre[widest] < right.centre[widest] ||
           (left.centre[widest] == right.centre[widest] && left.index < right.index);
  });
  return middle;
}

void BoxOrder::halve_down(const Range& range) {
  if (range.end - range.begin <= block) return;
  const std::size_t middle = halve(range);
  halve_down({range.begin, middle});
  halve_down({middle, range.end});
}

/// Halves the large ranges until `ranges_` holds only small ones.
void BoxOrder::halve_large() {
  for (std::size_t index = 0; index < ranges_.size(); ++index)
    while (ranges_[index].end - ranges_[index].begin > large_range) {
      const std::size_t middle = halve(ranges_[index]);
      ranges_.push_back({middle, ranges_[index].end});
      ranges_[index].end = middle;
    }
}

void BoxOrder::reserve(std::size_t boxes, std::size_t leaves) {
  unsorted_.reserve(boxes);
  items_.reserve(leaves);
  ranges_.reserve(class_count + 4 * (boxes / large_range));
}

std::size_t BoxOrder::byte_count() const {
  return bytes_of(unsorted_) + bytes_of(items_) + bytes_of(ranges_);
}

}  // namespace graze
