#include "solid/contour.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "closest_features/closest_features.hpp"
#include "measure/measure.hpp"

namespace graze {
namespace {

/// The way of the shift. No simple ratio holds between its coordinates, so that few planes are along it.
const Eigen::Vector3d shift_direction{1, 0.7548776662466927, 0.5698402909980532};
/// Its length, relative to the largest coordinate: far above the rounding of positions, and far below what
/// anyone sees.
constexpr double shift_size = 0x1p-36;

std::uint64_t number_of_triangle(std::uint32_t face, Piece piece) {
  return 2 * std::uint64_t{face} + (piece == Piece::second ? 1U : 0U);
}

/// Calls `visit(number, corners, piece)` for each triangle of a face whose corners are three vertices.
template <typename Visit>
void visit_triangles(const IndexedMesh& mesh, std::uint32_t face, const Visit& visit) {
  for (std::uint32_t i = 0; i < triangle_count(mesh, face); ++i) {
    const Piece piece = i == 0 ? Piece::first : Piece::second;
    const std::array<std::uint32_t, 3> corner = corners_of(mesh, face_piece(face, piece));
    if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0])
      visit(number_of_triangle(face, piece), corner, piece);
  }
}

FeaturePiece piece_of_segment(const FeatureRef& segment) {
  return segment.kind == FeatureRefKind::edge ? edge_piece(segment.index)
                                              : face_piece(segment.index, Piece::fold);
}

std::array<Eigen::Vector3d, 2> ends_of(const Simplex& segment) {
  return {segment.point[0], segment.point[1]};
}

Simplex moved(Simplex simplex, const Eigen::Vector3d& by) {
  for (std::uint32_t i = 0; i < simplex.size; ++i) simplex.point[i] += by;
  return simplex;
}

bool has(Shift shift, Shift asked) {
  return (static_cast<unsigned>(shift) & static_cast<unsigned>(asked)) != 0;
}

}  // namespace

Contour::Contour(const SurfacePair& pair, ContourScratch& scratch) : pair_(pair), scratch_(scratch) {
  scratch.points.clear();
  scratch.ends.clear();
  scratch.segments.clear();
  double largest = 0;
  for (const Surface* const surface : {&pair.a, &pair.b})
    for (const Eigen::Vector3d* const corner : {&surface->box().min, &surface->box().max})
      largest = std::max(largest, corner->cwiseAbs().maxCoeff());
  shift_ = shift_direction * (largest * shift_size);
}

double Contour::shift_length() const {
  return shift_.norm() * 2;  // with room for the rounding of moved positions
}

void Contour::add(const FeaturePair& pair) {
  const bool is_of_a = pair.a.kind != FeatureRefKind::face;
  const FeatureRef& segment = is_of_a ? pair.a : pair.b;
  const std::uint32_t face = is_of_a ? pair.b.index : pair.a.index;
  const Surface& own = is_of_a ? pair_.a : pair_.b;
  const Surface& other = is_of_a ? pair_.b : pair_.a;
  const Simplex along = simplex_of(own, piece_of_segment(segment));
  visit_triangles(other.mesh(), face, [&](std::uint64_t number, const auto& /*corner*/, Piece piece) {
    add({is_of_a, segment, along, face, simplex_of(other, face_piece(face, piece)), number});
  });
}

void Contour::add(const Candidate& candidate) {
  switch (lasting_crossing(ends_of(candidate.along), candidate.triangle.point, shift_length())) {
    case LastingCrossing::none:
      ++pair_.count.in_double;
      return;
    case LastingCrossing::unsure:
      add_shifted(candidate, Shift::up);
      add_shifted(candidate, Shift::down);
      return;
    case LastingCrossing::to_front:
      ++pair_.count.in_double;
      return add_place(candidate, true, Shift::both,
                       crossing_point(candidate.along, candidate.triangle, pair_.count));
    case LastingCrossing::to_back:
      ++pair_.count.in_double;
      return add_place(candidate, false, Shift::both,
                       crossing_point(candidate.along, candidate.triangle, pair_.count));
  }
}

/// Adds the place where they cross with b at one of its two places, if they do.
void Contour::add_shifted(const Candidate& candidate, Shift shift) {
  const Eigen::Vector3d by = shift == Shift::up ? shift_ : Eigen::Vector3d(-shift_);
  const Simplex along = candidate.is_of_a ? candidate.along : moved(candidate.along, by);
  const Simplex triangle = candidate.is_of_a ? moved(candidate.triangle, by) : candidate.triangle;
  // It goes on in the sense of the shift.
  const Nudge nudge = candidate.is_of_a == (shift == Shift::up) ? Nudge::triangle_up : Nudge::triangle_down;
  const CrossingWay way = crossing_way(ends_of(along), triangle.point, nudge, pair_.count);
  if (way != CrossingWay::none)
    add_place(candidate, way == CrossingWay::to_front, shift, crossing_point(along, triangle, pair_.count));
}

/// Adds an end for each triangle beside the segment. With d = n_a × n_b, a way e along the border of a
/// triangle of a leads into it where d · (n_a × e) = n_a² (n_b · e) is above 0. So a segment of the contour
/// starts there if the border, passed in the triangle's winding, goes to the front of the triangle of b. For
/// the border of a triangle of b it is d · (n_b × e) = −n_b² (n_a · e), which has the opposite sign.
void Contour::add_place(const Candidate& candidate, bool to_front, Shift shift,
                        const Eigen::Vector3d& point) {
  const auto index = static_cast<std::uint32_t>(scratch_.points.size());
  scratch_.points.push_back(point);
  visit_triangles_beside(candidate, [&](std::uint64_t number, bool is_in_winding) {
    ContourEnd end{number, candidate.triangle_number, index, shift, to_front == is_in_winding};
    if (!candidate.is_of_a) {
      std::swap(end.of_a, end.of_b);
      end.is_start = !end.is_start;
    }
    scratch_.ends.push_back(end);
  });
}

/// Calls `visit(number, is_in_winding)` for each triangle that has the segment as a side and may be tested
/// with the candidate's triangle. `is_in_winding`: its winding passes the segment from the first end to the
/// second.
template <typename Visit>
void Contour::visit_triangles_beside(const Candidate& candidate, const Visit& visit) const {
  const IndexedMesh& mesh = (candidate.is_of_a ? pair_.a : pair_.b).mesh();
  const std::uint32_t first = candidate.along.vertex[0];
  const std::uint32_t second = candidate.along.vertex[1];
  const FeatureRef other{FeatureRefKind::face, candidate.face};
  const auto visit_face = [&](std::uint32_t face) {
    const FeatureRef own{FeatureRefKind::face, face};
    if (!(candidate.is_of_a ? pair_.may(own, other) : pair_.may(other, own))) return;
    visit_triangles(mesh, face, [&](std::uint64_t number, const auto& corner, Piece /*piece*/) {
      for (std::size_t side = 0; side < 3; ++side) {
        const std::uint32_t from = corner[side];
        const std::uint32_t to = corner[(side + 1) % 3];
        if (from == first && to == second) visit(number, true);
        if (from == second && to == first) visit(number, false);
      }
    });
  };
  if (candidate.segment.kind == FeatureRefKind::fold) return visit_face(candidate.segment.index);
  for (const std::uint32_t face : mesh.edge_faces(candidate.segment.index)) visit_face(face);
}

void Contour::join() {
  auto& ends = scratch_.ends;
  std::sort(ends.begin(), ends.end(), [](const ContourEnd& left, const ContourEnd& right) {
    return std::tie(left.of_a, left.of_b, left.point) < std::tie(right.of_a, right.of_b, right.point);
  });
  for (std::size_t begin = 0; begin < ends.size();) {
    std::size_t end = begin + 1;
    while (end < ends.size() && ends[end].of_a == ends[begin].of_a && ends[end].of_b == ends[begin].of_b)
      ++end;
    join_ends(std::span(ends).subspan(begin, end - begin));
    begin = end;
  }
}

/// Joins the ends of one triangle of a and one of b: with each shift there are none or two.
void Contour::join_ends(std::span<const ContourEnd> ends) {
  const auto segment_with = [&](Shift shift) -> std::optional<ContourSegment> {
    std::optional<std::uint32_t> start;
    std::optional<std::uint32_t> end;
    for (const ContourEnd& each : ends)
      if (has(each.shift, shift)) (each.is_start ? start : end) = each.point;
    if (!start || !end) return std::nullopt;
    return ContourSegment{*start, *end, shift};
  };
  const std::optional<ContourSegment> up = segment_with(Shift::up);
  const std::optional<ContourSegment> down = segment_with(Shift::down);
  if (up && down && up->start == down->start && up->end == down->end) {
    scratch_.segments.push_back({up->start, up->end, Shift::both});
    return;
  }
  if (up) scratch_.segments.push_back(*up);
  if (down) scratch_.segments.push_back(*down);
}

bool Contour::crosses_either_way() const {
  const auto crosses_with = [&](Shift shift) {
    return std::any_of(scratch_.segments.begin(), scratch_.segments.end(),
                       [&](const ContourSegment& segment) { return has(segment.shift, shift); });
  };
  return crosses_with(Shift::up) && crosses_with(Shift::down);
}

ContourArea Contour::area() const {
  ContourArea result;
  if (scratch_.segments.empty()) return result;
  // Relative to a point of it and to its size, so that neither overflows, nor is lost to the place.
  const Eigen::Vector3d origin = scratch_.points[scratch_.segments.front().start];
  double size = 0;
  visit_points(
      [&](const Eigen::Vector3d& point) { size = std::max(size, (point - origin).cwiseAbs().maxCoeff()); });
  result.middle = origin;
  if (!(size > 0)) return result;
  const auto local = [&](std::uint32_t point) -> Eigen::Vector3d {
    return (scratch_.points[point] - origin) / size;
  };
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double length_of_all = 0;
  for (const ContourSegment& segment : scratch_.segments) {
    const Eigen::Vector3d p = local(segment.start);
    const Eigen::Vector3d q = local(segment.end);
    const double length = segment.weight() * (q - p).norm();
    weighted += (p + q) * (length / 2);
    length_of_all += length;
  }
  if (!(length_of_all > 0)) return result;
  const Eigen::Vector3d middle = weighted / length_of_all;
  double all = 0;
  for (const ContourSegment& segment : scratch_.segments) {
    const Eigen::Vector3d p = local(segment.start) - middle;
    const Eigen::Vector3d q = local(segment.end) - middle;
    const Eigen::Vector3d part = p.cross(q) * (segment.weight() / 2);
    result.area += part;
    all += part.norm();
  }
  result.middle = origin + middle * size;
  // A contour as narrow as the shift, such as a line, has an area by chance alone.
  const double by_chance = 8 * shift_length() / size * length_of_all;
  if (all > by_chance) result.fullness = std::min(1.0, result.area.norm() / all);
  return result;
}

}  // namespace graze
