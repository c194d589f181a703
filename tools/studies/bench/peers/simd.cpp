#include "bench/peers/simd.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "bench/peers/lanes.hpp"

namespace graze::bench {

FloatBox common(const FloatBox& a, const FloatBox& b) {
  FloatBox result;
  for (int axis = 0; axis < 3; ++axis) {
    result.min[axis] = std::max(a.min[axis], b.min[axis]);
    result.max[axis] = std::min(a.max[axis], b.max[axis]);
  }
  return result;
}

float square_above(double distance) {
  return static_cast<float>(distance * distance * (1 + 1e-6));
}

void PointList::make_room(std::size_t more) {
  constexpr std::size_t vector = 8;
  const std::size_t needed = count + more + vector;
  if (needed <= x.size()) return;
  for (std::vector<float>* values : {&x, &y, &z}) values->resize(2 * needed);
  index.resize(2 * needed);
}

#if defined(__AVX2__)
namespace {

/// Eight points' coordinates, from x0 y0 z0 x1 ….
struct Eight {
  __m256 x, y, z;
};

Eight load_eight(const float* points) {
  // Three rows of 128 bits each from the front and from the back half, then a shuffle within rows.
  const auto row = [&](int low, int high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(points + low)),
                                _mm_loadu_ps(points + high), 1);
  };
  const __m256 a = row(0, 12);                                         // x0 y0 z0 x1
  const __m256 b = row(4, 16);                                         // y1 z1 x2 y2
  const __m256 c = row(8, 20);                                         // z2 x3 y3 z3
  const __m256 bc = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));  // x2 y2 x3 y3
  const __m256 ab = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));  // y0 z0 y1 z1
  return {_mm256_shuffle_ps(a, bc, _MM_SHUFFLE(2, 0, 3, 0)),
          _mm256_shuffle_ps(ab, bc, _MM_SHUFFLE(3, 1, 2, 0)),
          _mm256_shuffle_ps(ab, c, _MM_SHUFFLE(3, 0, 3, 1))};
}

/// A box in eight lanes.
class EightBox {
 public:
  explicit EightBox(const FloatBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
      min_[axis] = _mm256_set1_ps(box.min[axis]);
      max_[axis] = _mm256_set1_ps(box.max[axis]);
    }
  }
  [[nodiscard]] std::uint32_t inside(const Eight& points) const {
    const __m256 in_x = between(points.x, 0);
    const __m256 in_y = between(points.y, 1);
    const __m256 in_z = between(points.z, 2);
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_and_ps(_mm256_and_ps(in_x, in_y), in_z)));
  }

 private:
  [[nodiscard]] __m256 between(__m256 value, int axis) const {
    return _mm256_and_ps(_mm256_cmp_ps(value, min_[axis], _CMP_GE_OQ),
                         _mm256_cmp_ps(value, max_[axis], _CMP_LE_OQ));
  }
  __m256 min_[3], max_[3];
};

void append(const Eight& points, __m256i index, std::uint32_t mask, PointList& list) {
  const __m256i lanes = lanes_of(mask);
  _mm256_storeu_ps(list.x.data() + list.count, _mm256_permutevar8x32_ps(points.x, lanes));
  _mm256_storeu_ps(list.y.data() + list.count, _mm256_permutevar8x32_ps(points.y, lanes));
  _mm256_storeu_ps(list.z.data() + list.count, _mm256_permutevar8x32_ps(points.z, lanes));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(list.index.data() + list.count),
                      _mm256_permutevar8x32_epi32(index, lanes));
  list.count += static_cast<std::size_t>(std::popcount(mask));
}

__m256i numbers_from(std::uint32_t first) {
  return _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                          _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}

std::uint32_t first_bits(std::size_t count) {
  return count >= 8 ? 0xffU : (1U << count) - 1;
}

}  // namespace

FloatBox box_of(const float* points, std::size_t count) {
  // Twenty-four floats are eight points, and lane k of each of three vectors is always of one axis.
  constexpr std::size_t row = 24;
  __m256 low[6], high[6];
  for (int i = 0; i < 6; ++i) {
    low[i] = _mm256_set1_ps(FloatBox::infinity);
    high[i] = _mm256_set1_ps(-FloatBox::infinity);
  }
  const std::size_t floats = 3 * count;
  std::size_t at = 0;
  for (; at + 2 * row <= floats; at += 2 * row)
    for (int i = 0; i < 6; ++i) {
      const __m256 values = _mm256_loadu_ps(points + at + 8 * static_cast<std::size_t>(i));
      low[i] = _mm256_min_ps(low[i], values);
      high[i] = _mm256_max_ps(high[i], values);
    }
  alignas(32) float lows[row], highs[row];
  for (std::size_t i = 0; i < 3; ++i) {
    _mm256_store_ps(lows + 8 * i, _mm256_min_ps(low[i], low[i + 3]));
    _mm256_store_ps(highs + 8 * i, _mm256_max_ps(high[i], high[i + 3]));
  }
  FloatBox box;
  for (std::size_t i = 0; i < row; ++i) {
    box.min[i % 3] = std::min(box.min[i % 3], lows[i]);
    box.max[i % 3] = std::max(box.max[i % 3], highs[i]);
  }
  for (; at < floats; at += 3) box.add(points + at);
  return box;
}

float sum_of(const float* numbers, std::size_t count) {
  __m256 sums[8];
  for (__m256& sum : sums) sum = _mm256_setzero_ps();
  std::size_t at = 0;
  for (; at + 64 <= count; at += 64)
    for (std::size_t i = 0; i < 8; ++i)
      sums[i] = _mm256_add_ps(sums[i], _mm256_loadu_ps(numbers + at + 8 * i));
  for (std::size_t i = 1; i < 8; ++i) sums[0] = _mm256_add_ps(sums[0], sums[i]);
  alignas(32) float lanes[8];
  _mm256_store_ps(lanes, sums[0]);
  float sum = 0;
  for (const float lane : lanes) sum += lane;
  for (; at < count; ++at) sum += numbers[at];
  return sum;
}

FloatBox PointList::box() const {
  FloatBox box;
  const std::vector<float>* const axes[3] = {&x, &y, &z};
  for (int axis = 0; axis < 3; ++axis) {
    const float* values = axes[axis]->data();
    __m256 low = _mm256_set1_ps(FloatBox::infinity);
    __m256 high = _mm256_set1_ps(-FloatBox::infinity);
    std::size_t at = 0;
    for (; at + 8 <= count; at += 8) {
      low = _mm256_min_ps(low, _mm256_loadu_ps(values + at));
      high = _mm256_max_ps(high, _mm256_loadu_ps(values + at));
    }
    alignas(32) float lows[8], highs[8];
    _mm256_store_ps(lows, low);
    _mm256_store_ps(highs, high);
    for (; at < count; ++at) {
      lows[0] = std::min(lows[0], values[at]);
      highs[0] = std::max(highs[0], values[at]);
    }
    box.min[axis] = *std::min_element(lows, lows + 8);
    box.max[axis] = *std::max_element(highs, highs + 8);
  }
  return box;
}

void add_inside(const float* points, std::uint32_t first, std::size_t count, const FloatBox& box,
                PointList& list) {
  list.make_room(count);
  const EightBox eight(box);
  std::size_t at = 0;
  for (; at + 8 <= count; at += 8) {
    const Eight values = load_eight(points + 3 * at);
    const std::uint32_t mask = eight.inside(values);
    if (mask != 0) append(values, numbers_from(first + static_cast<std::uint32_t>(at)), mask, list);
  }
  if (at == count) return;
  float rest[24] = {};
  std::copy(points + 3 * at, points + 3 * count, rest);
  const Eight values = load_eight(rest);
  const std::uint32_t mask = eight.inside(values) & first_bits(count - at);
  append(values, numbers_from(first + static_cast<std::uint32_t>(at)), mask, list);
}

void keep_inside(const FloatBox& box, PointList& list) {
  const EightBox eight(box);
  const std::size_t count = list.count;
  list.clear();
  for (std::size_t at = 0; at < count; at += 8) {
    const Eight values = {_mm256_loadu_ps(list.x.data() + at), _mm256_loadu_ps(list.y.data() + at),
                          _mm256_loadu_ps(list.z.data() + at)};
    const __m256i index = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(list.index.data() + at));
    append(values, index, eight.inside(values) & first_bits(count - at), list);
  }
}

std::uint32_t* add_near(const PointList& list, std::size_t begin, std::size_t end, float x, float y, float z,
                        float limit, std::uint32_t* out) {
  const __m256 px = _mm256_set1_ps(x);
  const __m256 py = _mm256_set1_ps(y);
  const __m256 pz = _mm256_set1_ps(z);
  const __m256 most = _mm256_set1_ps(limit);
  for (std::size_t at = begin; at < end; at += 8) {
    const __m256 dx = _mm256_sub_ps(_mm256_loadu_ps(list.x.data() + at), px);
    const __m256 dy = _mm256_sub_ps(_mm256_loadu_ps(list.y.data() + at), py);
    const __m256 dz = _mm256_sub_ps(_mm256_loadu_ps(list.z.data() + at), pz);
    const __m256 squared = _mm256_fmadd_ps(dx, dx, _mm256_fmadd_ps(dy, dy, _mm256_mul_ps(dz, dz)));
    auto mask = static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(squared, most, _CMP_LE_OQ)));
    if (mask == 0) continue;
    mask &= first_bits(end - at);
    for (; mask != 0; mask &= mask - 1)
      *out++ = static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(std::countr_zero(mask));
  }
  return out;
}

#else

FloatBox box_of(const float* points, std::size_t count) {
  FloatBox box;
  for (std::size_t i = 0; i < count; ++i) box.add(points + 3 * i);
  return box;
}

float sum_of(const float* numbers, std::size_t count) {
  std::array<float, 16> sums{};
  std::size_t at = 0;
  for (; at + 16 <= count; at += 16)
    for (std::size_t i = 0; i < 16; ++i) sums[i] += numbers[at + i];
  float sum = 0;
  for (const float part : sums) sum += part;
  for (; at < count; ++at) sum += numbers[at];
  return sum;
}

FloatBox PointList::box() const {
  FloatBox box;
  for (std::size_t i = 0; i < count; ++i) {
    const float point[3] = {x[i], y[i], z[i]};
    box.add(point);
  }
  return box;
}

namespace {

void add_if_inside(const FloatBox& box, const float (&point)[3], std::uint32_t number, PointList& list) {
  bool is_inside = true;
  for (int axis = 0; axis < 3; ++axis)
    is_inside = is_inside && point[axis] >= box.min[axis] && point[axis] <= box.max[axis];
  list.x[list.count] = point[0];
  list.y[list.count] = point[1];
  list.z[list.count] = point[2];
  list.index[list.count] = number;
  list.count += is_inside ? 1 : 0;
}

}  // namespace

void add_inside(const float* points, std::uint32_t first, std::size_t count, const FloatBox& box,
                PointList& list) {
  list.make_room(count);
  for (std::size_t i = 0; i < count; ++i)
    add_if_inside(box, {points[3 * i], points[3 * i + 1], points[3 * i + 2]},
                  first + static_cast<std::uint32_t>(i), list);
}

void keep_inside(const FloatBox& box, PointList& list) {
  const std::size_t count = list.count;
  list.clear();
  for (std::size_t i = 0; i < count; ++i)
    add_if_inside(box, {list.x[i], list.y[i], list.z[i]}, list.index[i], list);
}

std::uint32_t* add_near(const PointList& list, std::size_t begin, std::size_t end, float x, float y, float z,
                        float limit, std::uint32_t* out) {
  for (std::size_t at = begin; at < end; ++at) {
    const float dx = list.x[at] - x;
    const float dy = list.y[at] - y;
    const float dz = list.z[at] - z;
    *out = static_cast<std::uint32_t>(at);
    out += dx * dx + dy * dy + dz * dz <= limit ? 1 : 0;
  }
  return out;
}

#endif

}  // namespace graze::bench
