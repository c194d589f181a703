#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/contender.hpp"
#include "bench/peers/simd.hpp"

namespace graze::bench {

/// Some triangles' boxes, by coordinate. Whole vectors of eight may be read and written behind `count`.
struct BoxList {
  void clear() { count = 0; }
  void make_room(std::size_t more);
  [[nodiscard]] FloatBox box() const;
  [[nodiscard]] const std::vector<float>& low(int axis) const { return bounds[axis]; }
  [[nodiscard]] const std::vector<float>& high(int axis) const { return bounds[3 + axis]; }

  std::size_t count = 0;
  std::vector<float> bounds[6];  ///< min x, y, z, max x, y, z
  std::vector<std::uint32_t> index;
};

FloatBox triangle_box(const float* positions, const Triangle& triangle);

/// The boxes of all triangles of an object, in order.
void make_boxes(const World& world, std::size_t object, BoxList& list);

/// Adds those boxes of a list that meet `box`.
void add_meeting(const BoxList& all, const FloatBox& box, BoxList& list);
/// Keeps those that meet `box`.
void keep_meeting(const FloatBox& box, BoxList& list);

/// The places among `begin` to `end` of a list whose boxes have a squared distance from `box` of at most
/// `limit`. Returns behind the last one written. `out` has room for all and a vector.
std::uint32_t* add_near(const BoxList& list, std::size_t begin, std::size_t end, const FloatBox& box,
                        float limit, std::uint32_t* out);

/// Adds the pair if it is nearer than the world's distance.
void add_if_near(const World& world, std::uint32_t object_a, std::uint32_t triangle_a, std::uint32_t object_b,
                 std::uint32_t triangle_b, std::vector<TrianglePair>& found);

/// Adds the pair if it is nearer than the world's distance. The boxes of the triangles are compared first.
void add_if_boxes_near(const World& world, std::uint32_t object_a, std::uint32_t triangle_a,
                       std::uint32_t object_b, std::uint32_t triangle_b, std::vector<TrianglePair>& found);

}  // namespace graze::bench
