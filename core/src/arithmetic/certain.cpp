#include "arithmetic/certain.hpp"

#include <algorithm>
#include <cmath>

#include "arithmetic/arithmetic.hpp"

namespace graze {
namespace {

using Plain = Vector<double>;

constexpr double roundoff = 0x1p-53;

/// Squares of lengths between which neither products of four of them overflow nor rounding to denormals
/// matters.
constexpr double least_square = 0x1p-200;
constexpr double largest_square = 0x1p200;

bool is_in_range(double square) {
  return square >= least_square && square <= largest_square;
}

/// The range of the squared distance of two points `x` apart.
SquaredRange range_of_points(double xx) {
  return {xx * (1 - 8 * roundoff), xx * (1 + 8 * roundoff)};
}

/// The range of the squared distance of a point `x` from a point of a line along `direction`.
SquaredRange range_to_line(const Plain& direction, double length_squared, const Plain& x, double xx) {
  const Plain area = cross(direction, x);
  const double squared = dot(area, area) / length_squared;
  return {std::max(squared - 32 * roundoff * xx, 0.0), squared + 32 * roundoff * xx};
}

/// The range of the squared distance of a point `x` from a plane, or of two lines through points `x` apart.
/// It is measured along `normal`, the product of two vectors of the squared lengths given.
SquaredRange range_along(const Plain& normal, double normal_squared, double uu, double vv, const Plain& x,
                         double xx) {
  const double height = dot(normal, x);
  const double squared = height * height / normal_squared;
  const double off = 48 * roundoff * xx * (uu * vv / normal_squared);
  return {std::max(squared - off, 0.0), squared + off};
}

/// Whether a product of two vectors is so long, against what they allow, that it is certainly not zero and
/// known to 2^-20 of itself.
bool is_long(double normal_squared, double uu, double vv) {
  return normal_squared > 0x1p-60 * uu * vv;
}

/// Asks for signs of numbers that are off by a bound at most.
class Signs {
 public:
  [[nodiscard]] bool at_most_zero(double number, double bound) {
    certain_ = certain_ && std::abs(number) > bound;
    return number <= 0;
  }
  [[nodiscard]] bool certain() const { return certain_; }

 private:
  bool certain_ = true;
};

}  // namespace

bool certainly_not_parallel(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const Plain normal = cross(Plain{u.x(), u.y(), u.z()}, Plain{v.x(), v.y(), v.z()});
  return is_in_range(uu) && is_in_range(vv) && is_long(dot(normal, normal), uu, vv);
}

bool certain_voronoi(const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& corner,
                     VoronoiRegion& region, SquaredRange& squared) {
  const Plain u = difference<double>(corner[1], corner[0]);
  const Plain v = difference<double>(corner[2], corner[0]);
  const Plain from0 = difference<double>(point, corner[0]);
  const Plain from1 = difference<double>(point, corner[1]);
  const Plain from2 = difference<double>(point, corner[2]);
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  const double square0 = dot(from0, from0);
  const double square1 = dot(from1, from1);
  const double square2 = dot(from2, from2);
  const double longest = std::max(uu, vv);
  const double furthest = std::max(square0, std::max(square1, square2));
  const Plain normal = cross(u, v);
  const double normal_squared = dot(normal, normal);
  if (!is_in_range(uu) || !is_in_range(vv) || !is_in_range(furthest)) return false;
  if (!is_long(normal_squared, uu, vv)) return false;
  const double product = longest * furthest;
  const double off2 = 16 * roundoff * std::sqrt(product);
  const double off4 = 32 * roundoff * product;

  const double u0 = dot(u, from0);
  const double v0 = dot(v, from0);
  const double u1 = dot(u, from1);
  const double v1 = dot(v, from1);
  const double u2 = dot(u, from2);
  const double v2 = dot(v, from2);
  Signs signs;
  const auto linear = [&](double number) { return signs.at_most_zero(number, off2); };
  const auto square = [&](double number) { return signs.at_most_zero(number, off4); };
  if (linear(u0) && linear(v0)) {
    region = VoronoiRegion::vertex0;
    squared = range_of_points(square0);
  } else if (linear(-u1) && linear(v1 - u1)) {
    region = VoronoiRegion::vertex1;
    squared = range_of_points(square1);
  } else if (linear(-v2) && linear(u2 - v2)) {
    region = VoronoiRegion::vertex2;
    squared = range_of_points(square2);
  } else if (square(u0 * v1 - u1 * v0) && linear(-u0) && linear(u1)) {
    region = VoronoiRegion::edge01;
    squared = range_to_line(u, uu, from0, square0);
  } else if (square(u2 * v0 - u0 * v2) && linear(-v0) && linear(v2)) {
    region = VoronoiRegion::edge20;
    squared = range_to_line(v, vv, from0, square0);
  } else if (square(u1 * v2 - u2 * v1) && linear(u1 - v1) && linear(v2 - u2)) {
    region = VoronoiRegion::edge12;
    const Plain w = difference<double>(corner[2], corner[1]);
    const double ww = dot(w, w);
    if (!is_in_range(ww)) return false;
    squared = range_to_line(w, ww, from1, square1);
  } else {
    region = VoronoiRegion::inside;
    squared = range_along(normal, normal_squared, uu, vv, from0, square0);
  }
  return signs.certain();
}

namespace {

double to_unit_interval(double t) {
  return t > 0 ? std::min(t, 1.0) : 0;
}

/// A segment, and which way leads from each end to the other.
struct PlainSegment {
  const std::array<Eigen::Vector3d, 2>& end;
  Plain along;
  double length_squared;
};

PlainSegment segment_of(const std::array<Eigen::Vector3d, 2>& end) {
  const Plain along = difference<double>(end[1], end[0]);
  return {end, along, dot(along, along)};
}

/// Whether the closest points are certainly end `along` of a segment and a point inside the other. The foot
/// of the end has to be inside, and the way to the segment's other end has to lead away from it.
bool is_end_over_inside(const PlainSegment& segment, Along along, const PlainSegment& other,
                        SquaredRange& squared) {
  const std::size_t end = along == Along::first ? 0 : 1;
  const Plain x = difference<double>(segment.end[end], other.end[0]);
  const Plain y = difference<double>(segment.end[end], other.end[1]);
  const double xx = dot(x, x);
  const double yy = dot(y, y);
  const double furthest = std::max(xx, yy);
  if (!is_in_range(furthest)) return false;
  const double vx = dot(other.along, x);
  const double off = 8 * roundoff * std::sqrt(other.length_squared * furthest);
  if (!(vx > off && dot(other.along, y) < -off)) return false;
  const double sign = end == 0 ? 1 : -1;
  const double away =
      sign * (dot(segment.along, x) * other.length_squared - vx * dot(segment.along, other.along));
  if (!(away > 32 * roundoff * other.length_squared * std::sqrt(segment.length_squared * furthest)))
    return false;
  squared = range_to_line(other.along, other.length_squared, x, xx);
  return true;
}

/// Whether the closest points are certainly these two ends: the ways from each lead away from the other.
bool are_ends(const PlainSegment& a, Along along_a, const PlainSegment& b, Along along_b,
              SquaredRange& squared) {
  const std::size_t end_a = along_a == Along::first ? 0 : 1;
  const std::size_t end_b = along_b == Along::first ? 0 : 1;
  const Plain x = difference<double>(a.end[end_a], b.end[end_b]);
  const double xx = dot(x, x);
  if (!is_in_range(xx)) return false;
  const double away_a = (end_a == 0 ? 1 : -1) * dot(a.along, x);
  const double away_b = (end_b == 0 ? -1 : 1) * dot(b.along, x);
  if (!(away_a > 8 * roundoff * std::sqrt(a.length_squared * xx))) return false;
  if (!(away_b > 8 * roundoff * std::sqrt(b.length_squared * xx))) return false;
  squared = range_of_points(xx);
  return true;
}

Along along_of(double parameter) {
  if (parameter <= 0) return Along::first;
  return parameter >= 1 ? Along::second : Along::inside;
}

}  // namespace

bool certain_along(const std::array<Eigen::Vector3d, 2>& a, const std::array<Eigen::Vector3d, 2>& b,
                   std::array<Along, 2>& along, SquaredRange& squared) {
  const PlainSegment first = segment_of(a);
  const PlainSegment second = segment_of(b);
  const Plain w = difference<double>(b[0], a[0]);
  const double uu = first.length_squared;
  const double vv = second.length_squared;
  const double ww = dot(w, w);
  if (!is_in_range(uu) || !is_in_range(vv) || !(ww <= largest_square)) return false;
  const Plain normal = cross(first.along, second.along);
  const double determinant = dot(normal, normal);
  const double s = dot(cross(w, second.along), normal);
  const double t = dot(cross(w, first.along), normal);
  const double off = 16 * roundoff * uu * vv;
  const double off_s = 16 * roundoff * std::sqrt(uu * ww) * vv;
  const double off_t = 16 * roundoff * std::sqrt(vv * ww) * uu;
  if (is_long(determinant, uu, vv) && s > off_s && determinant - s > off + off_s && t > off_t &&
      determinant - t > off + off_t && ww >= least_square) {
    along = {Along::inside, Along::inside};
    squared = range_along(normal, determinant, uu, vv, w, ww);
    return true;
  }
  // A guess, which is then shown to be right or given up.
  const double uv = dot(first.along, second.along);
  const double uw = dot(first.along, w);
  const double vw = dot(second.along, w);
  double on_a = determinant > 0 ? to_unit_interval(s / determinant) : 0;
  const double on_b = to_unit_interval((uv * on_a - vw) / vv);
  on_a = to_unit_interval((uv * on_b + uw) / uu);
  along = {along_of(on_a), along_of(on_b)};
  if (along[0] != Along::inside && along[1] != Along::inside)
    return are_ends(first, along[0], second, along[1], squared);
  if (along[0] != Along::inside) return is_end_over_inside(first, along[0], second, squared);
  if (along[1] != Along::inside) return is_end_over_inside(second, along[1], first, squared);
  return false;
}

/// Projects both segments on the way between points that are about the closest. Any other way gives a bound,
/// too, so it does not matter how well they are found.
bool certainly_apart(const std::array<Eigen::Vector3d, 2>& a, const std::array<Eigen::Vector3d, 2>& b) {
  const Plain u = difference<double>(a[1], a[0]);
  const Plain r = difference<double>(b[0], a[0]);
  const Plain s = difference<double>(b[1], a[0]);
  const Plain v = s - r;
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  const double uv = dot(u, v);
  const double ur = dot(u, r);
  const double vr = dot(v, r);
  const double on_a = to_unit_interval((ur * vv - vr * uv) / (uu * vv - uv * uv));
  const double on_b = to_unit_interval((uv * on_a - vr) / vv);
  const Plain way = (r + v * on_b) - u * to_unit_interval((uv * on_b + ur) / uu);
  const double squared = dot(way, way);
  const double furthest = std::max(uu, std::max(dot(r, r), dot(s, s)));
  if (!is_in_range(squared) || !is_in_range(furthest)) return false;
  const double gap = std::min(dot(way, r), dot(way, s)) - std::max(dot(way, u), 0.0);
  return gap > 16 * roundoff * std::sqrt(squared * furthest);
}

Passing certain_passing(const std::array<Eigen::Vector3d, 2>& segment,
                        const std::array<Eigen::Vector3d, 3>& corner) {
  const Plain u = difference<double>(corner[1], corner[0]);
  const Plain v = difference<double>(corner[2], corner[0]);
  const Plain along = difference<double>(segment[1], segment[0]);
  const Plain to_second = difference<double>(segment[1], corner[0]);
  const std::array<Plain, 3> to{difference<double>(corner[0], segment[0]),
                                difference<double>(corner[1], segment[0]),
                                difference<double>(corner[2], segment[0])};
  const double sides = std::max(dot(u, u), dot(v, v));
  const double furthest = std::max(std::max(dot(to[0], to[0]), dot(to[1], to[1])),
                                   std::max(dot(to[2], to[2]), dot(to_second, to_second)));
  const double length_squared = dot(along, along);
  if (!is_in_range(sides) || !is_in_range(furthest) || !is_in_range(length_squared)) return Passing::unsure;
  const double off_side = 16 * roundoff * sides * std::sqrt(furthest);
  const double off_turn = 16 * roundoff * furthest * std::sqrt(length_squared);

  const Plain normal = cross(u, v);
  const double first = -dot(normal, to[0]);
  const double second = dot(normal, to_second);
  if (!(std::abs(first) > off_side && std::abs(second) > off_side)) return Passing::unsure;
  if ((first > 0) == (second > 0)) return Passing::no;
  Passing passing = Passing::yes;
  for (std::size_t side = 0; side < 3; ++side) {
    const double turn = dot(along, cross(to[side], to[(side + 1) % 3]));
    if (!(std::abs(turn) > off_turn))
      passing = Passing::unsure;
    else if ((turn > 0) != (second > 0))
      return Passing::no;
  }
  return passing;
}

}  // namespace graze
