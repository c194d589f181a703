#include "measure/measure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "arithmetic/direction.hpp"
#include "arithmetic/wide.hpp"
#include "closest_features/piercing.hpp"
#include "closest_features/ratio.hpp"
#include "measure/normals.hpp"

namespace graze {
namespace {

/// The closest points of two hulls, `low` with at most as many points as `high`. It holds how far each is
/// from its simplex's first point, and the gap from low to high, all times `denominator`.
template <typename Number>
struct ClosestPoints {
  Vector<Number> low_offset;
  Vector<Number> high_offset;
  Vector<Number> gap;
  Number denominator;
};

template <typename Number>
ClosestPoints<Number> closest_points(const Simplex& low, const Simplex& high) {
  const Vector<Number> zero{Number(0.0), Number(0.0), Number(0.0)};
  const Vector<Number> to_high = difference<Number>(high.point[0], low.point[0]);
  if (high.size == 1) return {zero, zero, to_high, Number(1.0)};
  const Vector<Number> from_high = difference<Number>(low.point[0], high.point[0]);
  const Vector<Number> v = difference<Number>(high.point[1], high.point[0]);
  if (high.size == 2 && low.size == 1) {
    const Number length_squared = dot(v, v);
    const Vector<Number> along = v * dot(v, from_high);
    return {zero, along, along - from_high * length_squared, length_squared};
  }
  if (high.size == 3) {
    const Vector<Number> normal = cross(v, difference<Number>(high.point[2], high.point[0]));
    const Number area_squared = dot(normal, normal);
    const Vector<Number> gap = normal * dot(normal, to_high);
    return {zero, from_high * area_squared + gap, gap, area_squared};
  }
  const Vector<Number> u = difference<Number>(low.point[1], low.point[0]);
  const Vector<Number> normal = cross(u, v);
  return {u * dot(cross(to_high, v), normal), v * dot(cross(to_high, u), normal),
          normal * dot(normal, to_high), dot(normal, normal)};
}

/// The closest points in whichever arithmetic they are asked for, made once in each.
class ClosestOf {
 public:
  ClosestOf(const Simplex& low, const Simplex& high)
      : low_(low), high_(high), ball_(closest_points<Ball>(low, high)) {}

  template <typename Number>
  const ClosestPoints<Number>& in() {
    if constexpr (std::is_same_v<Number, Ball>)
      return ball_;
    else if constexpr (std::is_same_v<Number, Wide>)
      return made(wide_);
    else
      return made(exact_);
  }

 private:
  template <typename Number>
  const ClosestPoints<Number>& made(std::optional<ClosestPoints<Number>>& points) const {
    if (!points) points.emplace(closest_points<Number>(low_, high_));
    return *points;
  }

  const Simplex& low_;
  const Simplex& high_;
  ClosestPoints<Ball> ball_;
  std::optional<ClosestPoints<Wide>> wide_;
  std::optional<ClosestPoints<Exact>> exact_;
};

/// The largest coordinate difference that the hulls are made of.
double extent(const Simplex& low, const Simplex& high) {
  double size = (high.point[0] - low.point[0]).cwiseAbs().maxCoeff();
  for (const Simplex* simplex : {&low, &high})
    for (std::uint32_t i = 1; i < simplex->size; ++i)
      size = std::max(size, (simplex->point[i] - simplex->point[0]).cwiseAbs().maxCoeff());
  return size;
}

/// numerator / denominator where that is certain to an absolute error of `error`.
bool quotient(const Ball& numerator, const Ball& denominator, double error, double& result) {
  const double smallest = denominator.value - denominator.radius * Ball::slack;
  if (!(smallest > 0x1p-900) || !std::isfinite(denominator.value)) return false;
  result = numerator.value / denominator.value;
  const double off = (numerator.radius + std::abs(result) * denominator.radius) / smallest;
  return std::isfinite(result) && off * Ball::slack <= error;
}

/// base + offset / denominator, from double where that is within `error`, else exactly rounded.
class PointRounder {
 public:
  PointRounder(DecisionCount& count, double error) : count_(count), error_(error) {}

  template <typename OffsetOf>
  Eigen::Vector3d round(const Eigen::Vector3d& base, const OffsetOf& offset_of) {
    Eigen::Vector3d offset;
    const auto [ball, ball_denominator] = offset_of.template operator()<Ball>();
    if (quotient(ball.x, ball_denominator, error_, offset.x()) &&
        quotient(ball.y, ball_denominator, error_, offset.y()) &&
        quotient(ball.z, ball_denominator, error_, offset.z()))
      return base + offset;
    const auto [wide, wide_denominator] = offset_of.template operator()<Wide>();
    const auto x = rounded_quotient(base.x(), wide.x, wide_denominator);
    const auto y = rounded_quotient(base.y(), wide.y, wide_denominator);
    const auto z = rounded_quotient(base.z(), wide.z, wide_denominator);
    if (x && y && z) return {*x, *y, *z};
    ++count_.exact;
    const auto [exact, denominator] = offset_of.template operator()<Exact>();
    return {Exact::quotient(Exact(base.x()) * denominator + exact.x, denominator),
            Exact::quotient(Exact(base.y()) * denominator + exact.y, denominator),
            Exact::quotient(Exact(base.z()) * denominator + exact.z, denominator)};
  }

 private:
  DecisionCount& count_;
  double error_;
};

/// The error allowed for distances and points, relative to the size of the features and their gap: the
/// contract's bound for distances. Stricter bounds send many more contacts of well-shaped meshes to exact
/// arithmetic (docs/tried.md).
constexpr double allowed_error = 0x1p-48;

template <typename Number>
using Fraction = std::pair<Vector<Number>, Number>;

/// The distance of the hulls, of which this is the square, within the allowed error or exactly rounded.
double distance_of(const SurfacePair& pair, const FeaturePairKey& key, const Ratio<Ball>& square,
                   double size) {
  const double bottom = square.denominator.value - square.denominator.radius * Ball::slack;
  if (bottom > 0x1p-900 && std::isfinite(square.numerator.value) && std::isfinite(square.denominator.value)) {
    const double low = std::sqrt(std::max(0.0, square.numerator.value - square.numerator.radius) /
                                 (square.denominator.value + square.denominator.radius));
    const double high = std::sqrt((square.numerator.value + square.numerator.radius) / bottom);
    const double middle = std::sqrt(square.numerator.value / square.denominator.value);
    if (square.numerator.value > 0x1p-900 && (high - low) * Ball::slack <= size * allowed_error)
      return middle;
  }
  return rounded_distance(pair, key).upper;
}

/// Fills in distance and normal of a contact whose points are known.
void complete(const SurfacePair& pair, const FeaturePairKey& key, const Hulls& hulls, ClosestOf& closest,
              Contact& contact) {
  const Ratio<Ball> square = hull_distance_squared<Ball>(hulls.a, hulls.b);
  bool unsure = false;
  const bool may_touch = sign(square.numerator, unsure) <= 0;
  if (may_touch && do_touch(hulls, pair.count)) {
    contact.distance = 0;
    contact.normal = touching_normal(pair.a, key.a(), pair.b, key.b(), pair.count);
    return;
  }
  const bool a_is_low = hulls.a.size <= hulls.b.size;
  contact.distance =
      distance_of(pair, key, square, extent(a_is_low ? hulls.a : hulls.b, a_is_low ? hulls.b : hulls.a));
  const auto normal = unit_direction(pair.count, [&]<typename Number>() { return closest.in<Number>().gap; });
  contact.normal = a_is_low ? *normal : Eigen::Vector3d(-*normal);
}

void add_sides(const SurfacePair& pair, const FeaturePairKey& key, Contact& contact) {
  if (contact.distance == 0) return;
  contact.side_a = side_of(pair.a, key.a(), contact.normal, pair.count);
  contact.side_b = side_of(pair.b, key.b(), -contact.normal, pair.count);
}

Contact named(const FeaturePairKey& key) {
  Contact contact;
  contact.kind = key.kind();
  contact.feature_a = key.a().feature;
  contact.feature_b = key.b().feature;
  return contact;
}

Contact measure_piercing(const SurfacePair& pair, const FeaturePairKey& key) {
  const Hulls hulls = hulls_of(pair, key);
  const bool a_is_segment = hulls.a.size < hulls.b.size;
  const Simplex& segment = a_is_segment ? hulls.a : hulls.b;
  const Simplex& triangle = a_is_segment ? hulls.b : hulls.a;
  Contact contact = named(key);
  contact.point_a = crossing_point(segment, triangle, pair.count);
  contact.point_b = contact.point_a;
  contact.normal = touching_normal(pair.a, key.a(), pair.b, key.b(), pair.count);
  return contact;
}

}  // namespace

Eigen::Vector3d crossing_point(const Simplex& segment, const Simplex& triangle, DecisionCount& count) {
  return PointRounder(count, extent(segment, triangle) * allowed_error)
      .round(segment.point[0], [&]<typename Number>() -> Fraction<Number> {
        bool unsure = false;  // either sign gives the same fraction
        const auto way = crossing_parameter<Number>(segment, triangle, unsure);
        return {difference<Number>(segment.point[1], segment.point[0]) * way.numerator, way.denominator};
      });
}

Contact measure_without_sides(const SurfacePair& pair, const FeaturePairKey& key) {
  if (key.meeting() == Meeting::pierced) return measure_piercing(pair, key);
  const Hulls hulls = hulls_of(pair, key);
  const bool a_is_low = hulls.a.size <= hulls.b.size;
  const Simplex& low = a_is_low ? hulls.a : hulls.b;
  const Simplex& high = a_is_low ? hulls.b : hulls.a;
  ClosestOf closest(low, high);
  PointRounder rounder(pair.count, extent(low, high) * allowed_error);
  Contact contact = named(key);
  Eigen::Vector3d& low_point = a_is_low ? contact.point_a : contact.point_b;
  Eigen::Vector3d& high_point = a_is_low ? contact.point_b : contact.point_a;
  low_point = low.point[0];
  high_point = high.point[0];
  if (low.size > 1)
    low_point = rounder.round(low.point[0], [&]<typename Number>() -> Fraction<Number> {
      return {closest.in<Number>().low_offset, closest.in<Number>().denominator};
    });
  if (high.size > 1)
    high_point = rounder.round(high.point[0], [&]<typename Number>() -> Fraction<Number> {
      return {closest.in<Number>().high_offset, closest.in<Number>().denominator};
    });
  complete(pair, key, hulls, closest, contact);
  return contact;
}

Contact measure(const SurfacePair& pair, const FeaturePairKey& key) {
  Contact contact = measure_without_sides(pair, key);
  add_sides(pair, key, contact);
  return contact;
}

Contact measure_parallel(const SurfacePair& pair, const FeaturePairKey& key, const Eigen::Vector3d& point_a,
                         const Eigen::Vector3d& point_b) {
  Contact contact = named(key);
  contact.point_a = point_a;
  contact.point_b = point_b;
  const Hulls hulls = hulls_of(pair, key);
  const bool a_is_low = hulls.a.size <= hulls.b.size;
  ClosestOf closest(a_is_low ? hulls.a : hulls.b, a_is_low ? hulls.b : hulls.a);
  complete(pair, key, hulls, closest, contact);
  add_sides(pair, key, contact);
  return contact;
}

Witness witness_of(const Contact& contact) {
  return {contact.feature_a, contact.feature_b, contact.point_a, contact.point_b};
}

}  // namespace graze
