#include "broad_phase.hpp"

#include <algorithm>
#include <tuple>

namespace graze {
namespace {

/// The axis along which the objects' boxes are spread most.
int widest_axis(std::span<const std::unique_ptr<Object>> objects) {
  Box centres;
  for (const auto& object : objects) centres.add(object->box.min);
  int axis = 0;
  if (!centres.empty()) (centres.max - centres.min).maxCoeff(&axis);
  return axis;
}

bool overlap(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

}  // namespace

std::span<const ObjectPair> BroadPhase::find(std::span<const std::unique_ptr<Object>> objects, double reach) {
  const int axis = widest_axis(objects);
  intervals_.clear();
  boxes_.clear();
  for (std::uint32_t index = 0; index < objects.size(); ++index) {
    boxes_.push_back(grown(objects[index]->box, reach / 2 + objects[index]->settings.margin));
    intervals_.push_back({boxes_.back().min[axis], boxes_.back().max[axis], index});
  }
  std::sort(intervals_.begin(), intervals_.end(), [](const Interval& left, const Interval& right) {
    return std::tie(left.begin, left.object) < std::tie(right.begin, right.object);
  });
  open_.clear();
  pairs_.clear();
  for (const Interval& interval : intervals_) {
    std::erase_if(open_, [&](const Interval& other) { return other.end < interval.begin; });
    for (const Interval& other : open_)
      if (overlap(boxes_[interval.object], boxes_[other.object]))
        pairs_.emplace_back(std::minmax(interval.object, other.object));
    open_.push_back(interval);
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace graze
