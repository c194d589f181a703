#include "overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "direction.hpp"

namespace graze {
namespace {

Outline points_of(const Simplex& simplex) {
  Outline points;
  for (std::uint32_t i = 0; i < simplex.size; ++i) points.push_back(simplex.point[i]);
  return points;
}

template <typename Number>
Vector<Number> direction_of(const Simplex& segment) {
  return difference<Number>(segment.point[1], segment.point[0]);
}

template <typename Number>
Vector<Number> normal_of(const Simplex& triangle) {
  return cross(difference<Number>(triangle.point[1], triangle.point[0]),
               difference<Number>(triangle.point[2], triangle.point[0]));
}

template <typename Number>
bool is_zero(const Vector<Number>& vector, bool& unsure) {
  return sign(dot(vector, vector), unsure) == 0;
}

/// Whether two parallel segments, projected on the first, share more than a point.
template <typename Number>
bool segments_overlap(const Simplex& a, const Simplex& b, bool& unsure) {
  const Vector<Number> u = direction_of<Number>(a);
  const Vector<Number> v = direction_of<Number>(b);
  if (is_zero(u, unsure) || is_zero(v, unsure) || !is_zero(cross(u, v), unsure)) return false;
  const Number length = dot(u, u);
  const Number first = dot(u, difference<Number>(b.point[0], a.point[0]));
  const Number second = dot(u, difference<Number>(b.point[1], a.point[0]));
  const bool starts_before_end = sign(first - length, unsure) < 0 || sign(second - length, unsure) < 0;
  const bool ends_after_start = sign(first, unsure) > 0 || sign(second, unsure) > 0;
  return starts_before_end && ends_after_start;
}

/// Whether a line in the plane of a triangle (through `origin` along `along`) has all of `other` on its outer
/// side or on it, where the inner side is that of `inner`. With `open`, what lies along the line is not on
/// its outer side.
template <typename Number>
bool separates(const Vector<Number>& plane_normal, const Eigen::Vector3d& origin, const Vector<Number>& along,
               const Eigen::Vector3d& inner, const Simplex& other, bool open, bool& unsure) {
  const Vector<Number> across = cross(plane_normal, along);
  const int inner_side = sign(dot(across, difference<Number>(inner, origin)), unsure);
  bool all_on_line = true;
  for (std::uint32_t i = 0; i < other.size; ++i) {
    const int side = inner_side * sign(dot(across, difference<Number>(other.point[i], origin)), unsure);
    if (side > 0) return false;
    all_on_line = all_on_line && side == 0;
  }
  return !(open && all_on_line);
}

template <typename Number>
bool a_side_separates(const Simplex& triangle, const Simplex& other, std::size_t fold_side, bool& unsure) {
  const Vector<Number> normal = normal_of<Number>(triangle);
  for (std::size_t side = 0; side < 3; ++side) {
    const Eigen::Vector3d& from = triangle.point[side];
    const Vector<Number> along = difference<Number>(triangle.point[(side + 1) % 3], from);
    if (separates(normal, from, along, triangle.point[(side + 2) % 3], other, side == fold_side, unsure))
      return true;
  }
  return false;
}

/// Whether a segment is parallel to a triangle's plane and passes over its inside: no separating line, which
/// for a segment and a triangle could only run along a side or along the segment.
template <typename Number>
bool segment_overlaps_triangle(const Simplex& segment, const Simplex& triangle, std::size_t fold_side,
                               bool& unsure) {
  const Vector<Number> normal = normal_of<Number>(triangle);
  const Vector<Number> u = direction_of<Number>(segment);
  if (is_zero(normal, unsure) || is_zero(u, unsure) || sign(dot(normal, u), unsure) != 0) return false;
  if (a_side_separates<Number>(triangle, segment, fold_side, unsure)) return false;
  const Vector<Number> across = cross(normal, u);
  std::array<int, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i)
    sides[i] = sign(dot(across, difference<Number>(triangle.point[i], segment.point[0])), unsure);
  const bool runs_along_fold = fold_side < 3 && sides[fold_side] == 0 && sides[(fold_side + 1) % 3] == 0;
  const bool before = std::find(sides.begin(), sides.end(), -1) != sides.end();
  const bool behind = std::find(sides.begin(), sides.end(), 1) != sides.end();
  return runs_along_fold || (before && behind);
}

template <typename Number>
bool triangles_overlap(const Simplex& a, const Simplex& b, bool& unsure) {
  const Vector<Number> normal_a = normal_of<Number>(a);
  const Vector<Number> normal_b = normal_of<Number>(b);
  if (is_zero(normal_a, unsure) || is_zero(normal_b, unsure) || !is_zero(cross(normal_a, normal_b), unsure))
    return false;
  return !a_side_separates<Number>(a, b, 3, unsure) && !a_side_separates<Number>(b, a, 3, unsure);
}

/// What is left of a convex polygon or segment inside the half space through `origin` with the normal
/// `inward`.
Outline clip(const Outline& points, const Eigen::Vector3d& origin, const Eigen::Vector3d& inward) {
  Outline kept;
  const std::size_t sides = points.size() == 2 ? 1 : points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double here = inward.dot(points[i] - origin);
    if (here >= 0) kept.push_back(points[i]);
    if (i >= sides) continue;
    const Eigen::Vector3d& next = points[(i + 1) % points.size()];
    const double there = inward.dot(next - origin);
    if ((here > 0 && there < 0) || (here < 0 && there > 0))
      kept.push_back(points[i] + (next - points[i]) * (here / (here - there)));
  }
  return kept;
}

/// The same for points of which something is known to be left: where rounding loses it, the point nearest to
/// it.
Outline clip_some(const Outline& points, const Eigen::Vector3d& origin, const Eigen::Vector3d& inward) {
  Outline kept = clip(points, origin, inward);
  if (kept.empty())
    kept.push_back(*std::max_element(points.begin(), points.end(),
                                     [&](const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
                                       return inward.dot(left - origin) < inward.dot(right - origin);
                                     }));
  return kept;
}

/// The unit normal of a triangle that has one, however thin: from the caller's coordinates, since local ones
/// are rounded.
Eigen::Vector3d plane_normal(const Simplex& triangle, DecisionCount& count) {
  return *unit_direction(count, [&]<typename Number>() { return normal_of<Number>(triangle); });
}

Outline clip_to_triangle(Outline points, const Simplex& triangle, const Eigen::Vector3d& normal) {
  for (std::size_t side = 0; side < 3; ++side) {
    const Eigen::Vector3d along = triangle.point[(side + 1) % 3] - triangle.point[side];
    points = clip_some(points, triangle.point[side], normal.cross(along));
  }
  return points;
}

Outline clip_to_segment(const Outline& points, const Simplex& segment) {
  const Eigen::Vector3d along = segment.point[1] - segment.point[0];
  return clip_some(clip_some(points, segment.point[0], along), segment.point[1], -along);
}

/// The two points of an outline that are furthest apart.
std::pair<Eigen::Vector3d, Eigen::Vector3d> longest_chord(const Outline& points) {
  std::pair<Eigen::Vector3d, Eigen::Vector3d> chord{points[0], points[0]};
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((points[i] - points[j]).squaredNorm() > (chord.first - chord.second).squaredNorm())
        chord = {points[j], points[i]};
  return chord;
}

/// The middle of a stretch or the centroid of an area, with its length or area. An area so thin that rounding
/// has lost its shape counts as its longest chord.
std::pair<Eigen::Vector3d, double> middle_of(const Outline& points) {
  const auto [from, to] = longest_chord(points);
  const double length = (to - from).norm();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double area = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d u = points[i] - points[0];
    const Eigen::Vector3d v = points[i + 1] - points[0];
    const double part = u.cross(v).norm() / 2;
    offset += (u + v) / 3 * part;
    area += part;
  }
  if (area > length * length * 0x1p-40) return {points[0] + offset / area, area};
  return {from + (to - from) / 2, points.size() == 2 ? length : area};
}

/// The point of the other, parallel piece straight across from `point`; `normal` is of its plane, if it is a
/// triangle.
Eigen::Vector3d across(const Eigen::Vector3d& point, const Simplex& other, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d offset = point - other.point[0];
  if (other.size == 3) return point - normal * normal.dot(offset);
  const Eigen::Vector3d along = other.point[1] - other.point[0];
  return other.point[0] + along * (along.dot(offset) / along.squaredNorm());
}

Eigen::Vector3d outline_normal(const Outline& outline) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    normal += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]);
  return normal.stableNormalized();
}

/// Whether two convex outlines lie on one line or in one plane and touch, to rounding.
bool meet(const Outline& outline, const Outline& other) {
  double slack = 0;
  for (const Eigen::Vector3d& point : outline) slack = std::max(slack, (point - other[0]).norm() * 0x1p-36);
  const Eigen::Vector3d normal = outline_normal(other);
  for (const Eigen::Vector3d& point : outline)
    if (std::abs(normal.dot(point - other[0])) > slack) return false;
  Outline common = outline;
  for (std::size_t i = 0; i < other.size() && !common.empty(); ++i) {
    const Eigen::Vector3d along = other[(i + 1) % other.size()] - other[i];
    const Eigen::Vector3d inward =
        (other.size() == 2 ? along : Eigen::Vector3d(normal.cross(along))).stableNormalized();
    common = clip(common, other[i] - inward * slack, inward);
  }
  return !common.empty();
}

/// Moves the middles of a whole by the same way; the gap between them stays.
void move_middles(Overlap& whole, const Eigen::Vector3d& way) {
  whole.middle_a += way;
  whole.middle_b += way;
}

/// Adds a stretch of the same line: the whole is from the first end to the last.
void join_stretch(Overlap& whole, const Overlap& part) {
  const Eigen::Vector3d along = whole.outline[1] - whole.outline[0];
  const Eigen::Vector3d before = (whole.outline[0] + whole.outline[1]) / 2;
  for (const Eigen::Vector3d& point : part.outline) {
    if (along.dot(point - whole.outline[0]) < 0) whole.outline[0] = point;
    if (along.dot(point - whole.outline[1]) > 0) whole.outline[1] = point;
  }
  move_middles(whole, (whole.outline[0] + whole.outline[1]) / 2 - before);
  whole.size = (whole.outline[1] - whole.outline[0]).norm();
}

/// Adds an area of the same plane: the middle is weighed by size.
void join_area(Overlap& whole, const Overlap& part) {
  const double size = whole.size + part.size;
  if (size > 0) move_middles(whole, (part.middle_a - whole.middle_a) * (part.size / size));
  whole.size = size;
}

}  // namespace

LocalFrame::LocalFrame(const Surface& surface_a, const Feature& feature_a, const Surface& surface_b,
                       const Feature& feature_b) {
  Box box;
  const auto add = [&](const Surface& surface, const Feature& feature) {
    if (feature.kind == FeatureKind::face)
      for (const std::uint32_t corner : surface.mesh().face(feature.index)) box.add(surface.position(corner));
    else
      for (const std::uint32_t end : surface.mesh().edge(feature.index)) box.add(surface.position(end));
  };
  add(surface_a, feature_a);
  add(surface_b, feature_b);
  origin_ = box.min;
  constexpr int most = 1000;
  scale_ = std::ldexp(1.0, -std::clamp(std::ilogb((box.max - box.min).maxCoeff()), -most, most));
}

Simplex LocalFrame::to_local(Simplex simplex) const {
  for (std::uint32_t i = 0; i < simplex.size; ++i) simplex.point[i] = (simplex.point[i] - origin_) * scale_;
  return simplex;
}

std::optional<Overlap> overlap_of(const Simplex& a, std::size_t fold_side_a, const Simplex& b,
                                  std::size_t fold_side_b, const LocalFrame& frame, DecisionCount& count) {
  const bool overlaps = decide(count, [&]<typename Number>(bool& unsure) {
    if (a.size == 2 && b.size == 2) return segments_overlap<Number>(a, b, unsure);
    if (a.size == 2) return segment_overlaps_triangle<Number>(a, b, fold_side_b, unsure);
    if (b.size == 2) return segment_overlaps_triangle<Number>(b, a, fold_side_a, unsure);
    return triangles_overlap<Number>(a, b, unsure);
  });
  if (!overlaps) return std::nullopt;
  // What is clipped is the lower one, so that the middle lies on it to rounding; straight across is on the
  // other.
  const bool a_is_low = a.size <= b.size;
  const Simplex low = frame.to_local(a_is_low ? a : b);
  const Simplex high = frame.to_local(a_is_low ? b : a);
  const Eigen::Vector3d normal =
      high.size == 3 ? plane_normal(a_is_low ? b : a, count) : Eigen::Vector3d::Zero().eval();
  const Outline common =
      high.size == 2 ? clip_to_segment(points_of(low), high) : clip_to_triangle(points_of(low), high, normal);
  const auto [middle, size] = middle_of(common);
  const Eigen::Vector3d opposite = across(middle, high, normal);
  return a_is_low ? Overlap{middle, opposite, size, common} : Overlap{opposite, middle, size, common};
}

Overlap largest_part(const Overlaps& overlaps) {
  std::array<std::size_t, 4> part{0, 1, 2, 3};
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (part[j] != part[i] && meet(overlaps[i].outline, overlaps[j].outline))
        std::replace(part.begin(), part.end(), std::max(part[i], part[j]), std::min(part[i], part[j]));
  }
  Overlap largest;
  for (std::size_t root = 0; root < overlaps.size(); ++root) {
    if (part[root] != root) continue;
    Overlap whole = overlaps[root];
    for (std::size_t i = root + 1; i < overlaps.size(); ++i)
      if (part[i] == root)
        whole.outline.size() == 2 ? join_stretch(whole, overlaps[i]) : join_area(whole, overlaps[i]);
    if (root == 0 || whole.size > largest.size * (1 + 0x1p-40)) largest = whole;
  }
  return largest;
}

}  // namespace graze
