#pragma once

#include <cstdint>

namespace graze::bench {

/// Whether two points of three floats are strictly nearer than `distance`. Differences of floats are exact in
/// double but for coordinates whose sizes differ by more than 2^29. Where rounding of the sum could decide, a
/// wider type does.
inline bool is_nearer(const float* p, const float* q, double distance) {
  const double x = static_cast<double>(p[0]) - static_cast<double>(q[0]);
  const double y = static_cast<double>(p[1]) - static_cast<double>(q[1]);
  const double z = static_cast<double>(p[2]) - static_cast<double>(q[2]);
  const double squared = x * x + y * y + z * z;
  const double limit = distance * distance;
  if (squared < limit * (1 - 1e-14)) return true;
  if (squared > limit * (1 + 1e-14)) return false;
  using Wide = long double;
  const Wide wide = static_cast<Wide>(x) * x + static_cast<Wide>(y) * y + static_cast<Wide>(z) * z;
  return wide < static_cast<Wide>(distance) * distance;
}

struct TrianglePoints {
  double corners[3][3];
};

/// The distance of two triangles, 0 where they meet. It is infinite where it is certainly not below `limit`.
/// As good as double allows.
double triangle_distance(const TrianglePoints& a, const TrianglePoints& b, double limit);

}  // namespace graze::bench
