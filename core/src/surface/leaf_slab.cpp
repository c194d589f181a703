#include "surface/leaf_slab.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>

#include "core/mesh/region_tree.hpp"
#include "kernels/point_registers.hpp"

namespace graze {
namespace {

/// How far points are from one of them, along a direction and in all, four at a time.
template <typename Number>
class Reach {
 public:
  Reach(const Number* numbers, std::uint32_t count, std::uint32_t from, const Eigen::Vector3f& direction)
      : points_(numbers, count), from_(points_.at(from)), direction_(direction.cast<Number>()) {}

  void add(std::span<const std::uint32_t> vertices) {
    std::size_t first = 0;
    for (; first + 4 <= vertices.size(); first += 4) add(vertices.data() + first);
    if (first == vertices.size()) return;
    std::array<std::uint32_t, 4> rest{};
    for (std::size_t i = 0; i < 4; ++i) rest[i] = vertices[std::min(first + i, vertices.size() - 1)];
    add(rest.data());
  }
  [[nodiscard]] double low() const {
    return over_lanes(low_, [](Number a, Number b) { return std::min(a, b); });
  }
  [[nodiscard]] double high() const {
    return over_lanes(high_, [](Number a, Number b) { return std::max(a, b); });
  }
  [[nodiscard]] double squared() const {
    return over_lanes(squared_, [](Number a, Number b) { return std::max(a, b); });
  }

 private:
  using Four = typename PointRegisters<Number>::Four;

  void add(const std::uint32_t* vertex) {
    Four v0;
    Four v1;
    Four v2;
    Four v3;
    points_.load(vertex[0], v0);
    points_.load(vertex[1], v1);
    points_.load(vertex[2], v2);
    points_.load(vertex[3], v3);
    const Four xy01 = GRAZE_SHUFFLE(v0, v1, 0, 4, 1, 5);
    const Four xy23 = GRAZE_SHUFFLE(v2, v3, 0, 4, 1, 5);
    const Four z01 = GRAZE_SHUFFLE(v0, v1, 2, 6, 2, 6);
    const Four z23 = GRAZE_SHUFFLE(v2, v3, 2, 6, 2, 6);
    const Four x = GRAZE_SHUFFLE(xy01, xy23, 0, 1, 4, 5) - from_[0];
    const Four y = GRAZE_SHUFFLE(xy01, xy23, 2, 3, 6, 7) - from_[1];
    const Four z = GRAZE_SHUFFLE(z01, z23, 0, 1, 4, 5) - from_[2];
    const Four along = x * direction_[0] + y * direction_[1] + z * direction_[2];
    const Four squared = x * x + y * y + z * z;
    low_ = GRAZE_PICK(along < low_, along, low_);
    high_ = GRAZE_PICK(along > high_, along, high_);
    squared_ = GRAZE_PICK(squared > squared_, squared, squared_);
  }
  template <typename Pick>
  static double over_lanes(const Four& of_lanes, Pick pick) {
    return static_cast<double>(pick(pick(of_lanes[0], of_lanes[1]), pick(of_lanes[2], of_lanes[3])));
  }

  static constexpr Number beyond = std::numeric_limits<Number>::infinity();
  PointRegisters<Number> points_;
  Eigen::Matrix<Number, 3, 1> from_;
  Eigen::Matrix<Number, 3, 1> direction_;
  Four low_{beyond, beyond, beyond, beyond};
  Four high_ = -low_;
  Four squared_{};
};

template <typename Number>
void set_reach(const Number* numbers, const Surface& surface, const Region& leaf, LeafSlab& slab) {
  const RegionTree& tree = surface.mesh().regions();
  Reach<Number> reach(numbers, surface.mesh().vertex_count(), leaf.middle, slab.normal);
  reach.add(tree.vertices(leaf));
  reach.add(tree.border(leaf));
  // Rounding, that to float too, is relative to the ways from the middle, but for what underflow loses.
  constexpr double lost = std::is_same_v<Number, float> ? 0x1p-70 : 0x1p-140;
  const double radius = std::sqrt(reach.squared()) * (1 + 0x1p-20) + lost;
  slab.radius = static_cast<float>(radius);
  slab.low = static_cast<float>(reach.low() - radius * 0x1p-20 - lost);
  slab.high = static_cast<float>(reach.high() + radius * 0x1p-20 + lost);
}

/// Whether b, which is `between` away, is further than a distance from a as seen along a's normal. A corner
/// of b at a height h along its own normal is at `cosine` times h there, but for at most `sine` times its
/// distance from b's middle.
bool is_apart(const LeafSlab& a, const LeafSlab& b, const Eigen::Vector3d& between, double cosine,
              double sine, double distance) {
  const double way = a.normal.cast<double>().dot(between);
  const double at_low = cosine * static_cast<double>(b.low);
  const double at_high = cosine * static_cast<double>(b.high);
  const double around = static_cast<double>(b.radius) * sine;
  return way + std::min(at_low, at_high) - around > static_cast<double>(a.high) + distance ||
         way + std::max(at_low, at_high) + around < static_cast<double>(a.low) - distance;
}

}  // namespace

LeafSlab slab_of(const Surface& surface, const Region& leaf) {
  const auto [first, second, third] = surface.mesh().regions().spread(leaf);
  const Eigen::Vector3d corner = surface.position(first);
  const Eigen::Vector3d across = (surface.position(second) - corner).cross(surface.position(third) - corner);
  const double squared = across.squaredNorm();
  LeafSlab slab;
  if (!(squared > 0x1p-900) || !(squared < 0x1p900)) return slab;
  slab.normal = (across * ((1 - 0x1p-22) / std::sqrt(squared))).cast<float>();
  const PositionView positions = surface.positions();
  if (positions.is_double())
    set_reach(static_cast<const double*>(positions.data()), surface, leaf, slab);
  else
    set_reach(static_cast<const float*>(positions.data()), surface, leaf, slab);
  return slab;
}

bool are_apart(const LeafSlab& a, const LeafSlab& b, const Eigen::Vector3d& between, double distance) {
  if (!a.is_known() || !b.is_known()) return false;
  const double cosine = a.normal.cast<double>().dot(b.normal.cast<double>());
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine) + 0x1p-18);  // lengths are not quite 1
  const double sizes = between.cwiseAbs().sum() + static_cast<double>(a.radius + b.radius);
  const double further = distance + sizes * 0x1p-40 + lost_to_underflow;
  return is_apart(a, b, between, cosine, sine, further) || is_apart(b, a, -between, cosine, sine, further);
}

// The contents are between the two planes, and within the radius of the middle vertex. So they are no nearer
// along the normal than the planes, and no nearer across it than a circle of that radius.
double lower_squared(const LeafSlab& slab, const Eigen::Vector3d& way) {
  if (!slab.is_known()) return 0;
  const double height = slab.normal.cast<double>().dot(way);
  const double lost = (way.cwiseAbs().sum() + static_cast<double>(slab.radius)) * 0x1p-40 + lost_to_underflow;
  const double over = std::max(
      0.0, std::max(height - static_cast<double>(slab.high), static_cast<double>(slab.low) - height) - lost);
  // The normal may be a little shorter than 1, and the height by as much less than it is.
  const double across_squared = way.squaredNorm() - height * height * (1 + 0x1p-18);
  const double across =
      std::max(0.0, std::sqrt(std::max(0.0, across_squared)) - static_cast<double>(slab.radius) - lost);
  return (over * over + across * across) * round_down;
}

}  // namespace graze
