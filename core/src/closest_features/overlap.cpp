#include "closest_features/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "arithmetic/certain.hpp"
#include "arithmetic/direction.hpp"

namespace graze {
namespace {

Outline points_of(const Simplex& simplex) {
  Outline points;
  for (std::uint32_t i = 0; i < simplex.size; ++i) points.push_back(simplex.point[i]);
  return points;
}

template <typename Number>
Vector<Number> normal_of(const Simplex& triangle) {
  return normal_of_corners<Number>(triangle.point);
}

bool has_area(const Simplex& triangle, DecisionCount& count) {
  if (certainly_not_parallel(triangle.point[1] - triangle.point[0], triangle.point[2] - triangle.point[0])) {
    ++count.in_double;
    return true;
  }
  return !is_zero(count, [&]<typename Number>() { return normal_of<Number>(triangle); });
}

/// The sign of the product of `along` and a difference of two points.
int sign_along(const Simplex& along, const Eigen::Vector3d& to, const Eigen::Vector3d& from,
               DecisionCount& count) {
  return decide_sign(count, [&]<typename Number>() {
    return dot(difference<Number>(along.point[1], along.point[0]), difference<Number>(to, from));
  });
}

/// Whether two segments are parallel and, projected on the first, share more than a point.
bool segments_overlap(const Simplex& a, const Simplex& b, DecisionCount& count) {
  if (a.point[0] == a.point[1] || b.point[0] == b.point[1]) return false;
  const bool are_parallel = is_zero(count, [&]<typename Number>() {
    return cross(difference<Number>(a.point[1], a.point[0]), difference<Number>(b.point[1], b.point[0]));
  });
  if (!are_parallel) return false;
  const bool starts_before_end =
      sign_along(a, b.point[0], a.point[1], count) < 0 || sign_along(a, b.point[1], a.point[1], count) < 0;
  return starts_before_end && (sign_along(a, b.point[0], a.point[0], count) > 0 ||
                               sign_along(a, b.point[1], a.point[0], count) > 0);
}

/// On which side of the line through two points of a triangle's plane a point of that plane is, or one over
/// it.
int side_of_line(const Simplex& triangle, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                 const Eigen::Vector3d& point, DecisionCount& count) {
  if (point == from || point == to) return 0;
  return decide_sign(count, [&]<typename Number>() {
    return dot(normal_of<Number>(triangle),
               cross(difference<Number>(to, from), difference<Number>(point, from)));
  });
}

/// Whether a side of a triangle has all of `other` on its outer side or on it. What lies along the fold side
/// is not on its outer side.
bool a_side_separates(const Simplex& triangle, const Simplex& other, std::size_t fold_side,
                      DecisionCount& count) {
  for (std::size_t side = 0; side < 3; ++side) {
    bool all_outside = true;
    bool all_on_line = true;
    for (std::uint32_t i = 0; i < other.size && all_outside; ++i) {
      const int inside =
          side_of_line(triangle, triangle.point[side], triangle.point[(side + 1) % 3], other.point[i], count);
      all_outside = inside <= 0;
      all_on_line = all_on_line && inside == 0;
    }
    if (all_outside && !(all_on_line && side == fold_side)) return true;
  }
  return false;
}

bool is_corner(const Eigen::Vector3d& point, const Simplex& triangle) {
  return std::find(triangle.point.begin(), triangle.point.end(), point) != triangle.point.end();
}

/// Whether a segment is parallel to a triangle's plane and passes over its inside. It does where no line
/// separates them, which could only run along a side or along the segment.
bool segment_overlaps_triangle(const Simplex& segment, const Simplex& triangle, std::size_t fold_side,
                               DecisionCount& count) {
  const Eigen::Vector3d& p = segment.point[0];
  const Eigen::Vector3d& q = segment.point[1];
  if (p == q || !has_area(triangle, count)) return false;
  // Sides are asked first: whether a segment is parallel is mostly a question of zero, which takes longest.
  if (a_side_separates(triangle, segment, fold_side, count)) return false;
  const bool is_side = is_corner(p, triangle) && is_corner(q, triangle);
  const bool is_parallel = is_side || decide_sign(count, [&]<typename Number>() {
                                        return dot(normal_of<Number>(triangle), difference<Number>(q, p));
                                      }) == 0;
  if (!is_parallel) return false;
  std::array<int, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) sides[i] = side_of_line(triangle, p, q, triangle.point[i], count);
  const bool runs_along_fold = fold_side < 3 && sides[fold_side] == 0 && sides[(fold_side + 1) % 3] == 0;
  const bool before = std::find(sides.begin(), sides.end(), -1) != sides.end();
  const bool behind = std::find(sides.begin(), sides.end(), 1) != sides.end();
  return runs_along_fold || (before && behind);
}

bool triangles_overlap(const Simplex& a, const Simplex& b, DecisionCount& count) {
  if (!has_area(a, count)) return false;
  const auto is_of_a = [&](const Eigen::Vector3d& corner) { return is_corner(corner, a); };
  const bool has_corners_of_a = std::all_of(b.point.begin(), b.point.end(), is_of_a);
  if (!has_area(b, count)) return false;
  if (has_corners_of_a) return true;
  const bool are_parallel =
      is_zero(count, [&]<typename Number>() { return cross(normal_of<Number>(a), normal_of<Number>(b)); });
  return are_parallel && !a_side_separates(a, b, 3, count) && !a_side_separates(b, a, 3, count);
}

/// Clips a convex polygon or segment by the half space through `origin` with the normal `inward`.
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

/// Whether all points lie along the line or plane, to rounding: an edge along a fold, which is inside the
/// face.
bool lie_along(const Outline& points, const Eigen::Vector3d& origin, const Eigen::Vector3d& inward) {
  constexpr double rounding = 0x1p-45;  // of coordinates near 1 in a local frame
  const double slack = rounding * inward.norm();
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return std::abs(inward.dot(point - origin)) <= slack;
  });
}

/// Clips points of which some are known to be inside. Where rounding loses these, keeps the point nearest to
/// the half space.
Outline clip_some(const Outline& points, const Eigen::Vector3d& origin, const Eigen::Vector3d& inward) {
  if (lie_along(points, origin, inward)) return points;
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

/// The point of the other, parallel piece straight across from `point`. `normal` is of its plane, if it is a
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

/// Moves the middles of a whole by the same way. The gap between them stays.
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

bool do_overlap(const Simplex& a, std::size_t fold_side_a, const Simplex& b, std::size_t fold_side_b,
                DecisionCount& count) {
  if (a.size == 2 && b.size == 2) return segments_overlap(a, b, count);
  if (a.size == 2) return segment_overlaps_triangle(a, b, fold_side_b, count);
  if (b.size == 2) return segment_overlaps_triangle(b, a, fold_side_a, count);
  return triangles_overlap(a, b, count);
}

Overlap overlap_of(const Simplex& a, const Simplex& b, const LocalFrame& frame, DecisionCount& count) {
  // The lower piece is clipped, so that the middle lies on it to rounding. The point straight across is on
  // the other one.
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
