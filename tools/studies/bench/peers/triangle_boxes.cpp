#include "bench/peers/triangle_boxes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bench/peers/exact_distance.hpp"
#include "bench/peers/lanes.hpp"

namespace graze::bench {
namespace {

TrianglePoints points_of(const World& world, std::uint32_t object, std::uint32_t triangle) {
  const float* positions = world.positions_of(object);
  TrianglePoints points;
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis)
      points.corners[i][axis] = static_cast<double>(
          positions[3 * std::size_t{world.objects[object].triangles[triangle].corners[i]} +
                    static_cast<std::size_t>(axis)]);
  return points;
}

void put(BoxList& list, std::size_t place, const FloatBox& box, std::uint32_t index) {
  for (int axis = 0; axis < 3; ++axis) {
    list.bounds[axis][place] = box.min[axis];
    list.bounds[3 + axis][place] = box.max[axis];
  }
  list.index[place] = index;
}

}  // namespace

void BoxList::make_room(std::size_t more) {
  constexpr std::size_t vector = 8;
  const std::size_t needed = count + more + vector;
  if (needed <= index.size()) return;
  for (std::vector<float>& values : bounds) values.resize(2 * needed);
  index.resize(2 * needed);
}

FloatBox BoxList::box() const {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const float* lows = low(axis).data();
    const float* highs = high(axis).data();
    float least = FloatBox::infinity;
    float most = -FloatBox::infinity;
    for (std::size_t i = 0; i < count; ++i) {
      least = lows[i] < least ? lows[i] : least;
      most = highs[i] > most ? highs[i] : most;
    }
    box.min[axis] = least;
    box.max[axis] = most;
  }
  return box;
}

FloatBox triangle_box(const float* positions, const Triangle& triangle) {
  FloatBox box;
  for (const std::uint32_t corner : triangle.corners) box.add(positions + 3 * std::size_t{corner});
  return box;
}

void make_boxes(const World& world, std::size_t object, BoxList& list) {
  const auto& triangles = world.objects[object].triangles;
  const float* positions = world.positions_of(object);
  list.clear();
  list.make_room(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    put(list, i, triangle_box(positions, triangles[i]), static_cast<std::uint32_t>(i));
  list.count = triangles.size();
}

#if defined(__AVX2__)
namespace {

/// Moves those boxes from one list to another, or forward in one, that meet `box`.
void move_meeting(const BoxList& from, std::size_t count, const FloatBox& box, BoxList& to) {
  __m256 low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = _mm256_set1_ps(box.min[axis]);
    high[axis] = _mm256_set1_ps(box.max[axis]);
  }
  for (std::size_t at = 0; at < count; at += 8) {
    __m256 values[6];
    for (int i = 0; i < 6; ++i) values[i] = _mm256_loadu_ps(from.bounds[i].data() + at);
    __m256 is_met = _mm256_cmp_ps(values[0], high[0], _CMP_LE_OQ);
    for (int axis = 1; axis < 3; ++axis)
      is_met = _mm256_and_ps(is_met, _mm256_cmp_ps(values[axis], high[axis], _CMP_LE_OQ));
    for (int axis = 0; axis < 3; ++axis)
      is_met = _mm256_and_ps(is_met, _mm256_cmp_ps(values[3 + axis], low[axis], _CMP_GE_OQ));
    auto mask = static_cast<std::uint32_t>(_mm256_movemask_ps(is_met));
    if (count - at < 8) mask &= (1U << (count - at)) - 1;
    if (mask == 0) continue;
    const __m256i lanes = lanes_of(mask);
    const __m256i index = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from.index.data() + at));
    for (int i = 0; i < 6; ++i)
      _mm256_storeu_ps(to.bounds[i].data() + to.count, _mm256_permutevar8x32_ps(values[i], lanes));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to.index.data() + to.count),
                        _mm256_permutevar8x32_epi32(index, lanes));
    to.count += static_cast<std::size_t>(std::popcount(mask));
  }
}

}  // namespace

std::uint32_t* add_near(const BoxList& list, std::size_t begin, std::size_t end, const FloatBox& box,
                        float limit, std::uint32_t* out) {
  const __m256 most = _mm256_set1_ps(limit);
  __m256 low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = _mm256_set1_ps(box.min[axis]);
    high[axis] = _mm256_set1_ps(box.max[axis]);
  }
  for (std::size_t at = begin; at < end; at += 8) {
    __m256 squared = _mm256_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 below = _mm256_sub_ps(low[axis], _mm256_loadu_ps(list.high(axis).data() + at));
      const __m256 above = _mm256_sub_ps(_mm256_loadu_ps(list.low(axis).data() + at), high[axis]);
      const __m256 gap = _mm256_max_ps(_mm256_max_ps(below, above), _mm256_setzero_ps());
      squared = _mm256_fmadd_ps(gap, gap, squared);
    }
    auto mask = static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(squared, most, _CMP_LE_OQ)));
    if (end - at < 8) mask &= (1U << (end - at)) - 1;
    for (; mask != 0; mask &= mask - 1)
      *out++ = static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(std::countr_zero(mask));
  }
  return out;
}

#else
namespace {

void move_meeting(const BoxList& from, std::size_t count, const FloatBox& box, BoxList& to) {
  for (std::size_t at = 0; at < count; ++at) {
    bool is_met = true;
    float values[6];
    for (int i = 0; i < 6; ++i) values[i] = from.bounds[i][at];
    for (int axis = 0; axis < 3; ++axis)
      is_met = is_met && values[axis] <= box.max[axis] && values[3 + axis] >= box.min[axis];
    const std::uint32_t index = from.index[at];
    for (int i = 0; i < 6; ++i) to.bounds[i][to.count] = values[i];
    to.index[to.count] = index;
    to.count += is_met ? 1 : 0;
  }
}

}  // namespace

std::uint32_t* add_near(const BoxList& list, std::size_t begin, std::size_t end, const FloatBox& box,
                        float limit, std::uint32_t* out) {
  for (std::size_t at = begin; at < end; ++at) {
    float squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float gap =
          std::max({box.min[axis] - list.high(axis)[at], list.low(axis)[at] - box.max[axis], 0.0F});
      squared += gap * gap;
    }
    *out = static_cast<std::uint32_t>(at);
    out += squared <= limit ? 1 : 0;
  }
  return out;
}

#endif

void add_meeting(const BoxList& all, const FloatBox& box, BoxList& list) {
  list.make_room(all.count);
  move_meeting(all, all.count, box, list);
}

void keep_meeting(const FloatBox& box, BoxList& list) {
  const std::size_t count = list.count;
  list.clear();
  move_meeting(list, count, box, list);
}

void add_if_near(const World& world, std::uint32_t object_a, std::uint32_t triangle_a, std::uint32_t object_b,
                 std::uint32_t triangle_b, std::vector<TrianglePair>& found) {
  const double distance = triangle_distance(points_of(world, object_a, triangle_a),
                                            points_of(world, object_b, triangle_b), world.distance);
  if (distance < world.distance) found.push_back({object_a, object_b, triangle_a, triangle_b, distance});
}

void add_if_boxes_near(const World& world, std::uint32_t object_a, std::uint32_t triangle_a,
                       std::uint32_t object_b, std::uint32_t triangle_b, std::vector<TrianglePair>& found) {
  const FloatBox a =
      triangle_box(world.positions_of(object_a), world.objects[object_a].triangles[triangle_a]);
  const FloatBox b =
      triangle_box(world.positions_of(object_b), world.objects[object_b].triangles[triangle_b]);
  float squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float gap = std::max({a.min[axis] - b.max[axis], b.min[axis] - a.max[axis], 0.0F});
    squared += gap * gap;
  }
  if (squared <= square_above(world.distance))
    add_if_near(world, object_a, triangle_a, object_b, triangle_b, found);
}

}  // namespace graze::bench
