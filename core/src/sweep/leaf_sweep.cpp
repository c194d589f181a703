#include "sweep/leaf_sweep.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/mesh/pair_room.hpp"

namespace graze {
namespace {

constexpr double last_time = 1;

/// Adds those of some features that meet a box. `corners_of` gives the vertices of a feature.
template <typename CornersOf>
void collect_some(const MovingSurface& surface, std::span<const std::uint32_t> features,
                  const MovingBox& near, double gap, const CornersOf& corners_of,
                  std::vector<MovingFeatures::Feature>& found) {
  found.clear();
  for (const std::uint32_t index : features) {
    MovingBox box;
    for (const std::uint32_t vertex : corners_of(index))
      box.add(surface.at_start(vertex), surface.at_end(vertex));
    if (gap > 0) box = grown(box, gap);
    if (first_meeting(box, near) <= last_time) found.push_back({box, index});
  }
}

FeatureSweep sweep_of(const MovingSurface& first, std::uint32_t vertex, const MovingSurface& second,
                      const std::array<std::uint32_t, 3>& corners) {
  FeatureSweep sweep;
  sweep.start[0] = first.at_start(vertex);
  sweep.end[0] = first.at_end(vertex);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sweep.start[i + 1] = second.at_start(corners[i]);
    sweep.end[i + 1] = second.at_end(corners[i]);
  }
  return sweep;
}

/// Joins what two triangles of one quad say: the first meeting of either. It is certain if one meeting is.
void join(std::optional<SweptMeeting>& meeting, const std::optional<SweptMeeting>& other) {
  if (!meeting || !other) {
    if (!meeting) meeting = other;
    return;
  }
  const bool is_possible = meeting->status == ImpactStatus::possible;
  const bool is_other_possible = other->status == ImpactStatus::possible;
  if (is_possible == is_other_possible)
    meeting->upper = std::min(meeting->upper, other->upper);
  else if (is_possible)
    meeting->upper = other->upper;
  meeting->lower = std::min(meeting->lower, other->lower);
  if (meeting->status == ImpactStatus::at_start || other->status == ImpactStatus::at_start)
    *meeting = {0, 0, ImpactStatus::at_start};
  else if (is_possible && !is_other_possible)
    meeting->status = ImpactStatus::certain;
}

bool has(std::span<const std::uint32_t> vertices, std::uint32_t vertex) {
  return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
}

}  // namespace

void MovingFeatures::collect(const MovingSurface& surface, const Region& leaf, const MovingBox& near,
                             double gap) {
  const IndexedMesh& mesh = surface.mesh();
  const RegionTree& tree = mesh.regions();
  collect_some(
      surface, tree.vertices(leaf), near, gap,
      [](std::uint32_t vertex) { return std::array<std::uint32_t, 1>{vertex}; }, vertices);
  collect_some(
      surface, tree.edges(leaf), near, gap, [&](std::uint32_t edge) { return mesh.edge(edge); }, edges);
  collect_some(
      surface, tree.faces(leaf), near, gap, [&](std::uint32_t face) { return mesh.face(face); }, faces);
}

void MovingFeatures::reserve(const PairRoom& room) {
  vertices.reserve(room.leaf_vertices);
  edges.reserve(room.leaf_edges);
  faces.reserve(room.leaf_faces);
}

void LeafSweep::test(const MovingFeatures& of_a, const MovingFeatures& of_b, bool same) {
  test_all(of_a.vertices, of_b.faces,
           [&](std::uint32_t vertex, std::uint32_t face) { test_vertex_face(vertex, face, true); });
  if (!same)
    test_all(of_a.faces, of_b.vertices,
             [&](std::uint32_t face, std::uint32_t vertex) { test_vertex_face(vertex, face, false); });
  test_all(of_a.edges, of_b.edges, [&](std::uint32_t edge_a, std::uint32_t edge_b) {
    if (!same || edge_a < edge_b) test_edges(edge_a, edge_b);
  });
}

template <typename Test>
void LeafSweep::test_all(const std::vector<MovingFeatures::Feature>& of_a,
                         const std::vector<MovingFeatures::Feature>& of_b, const Test& test) {
  for (const MovingFeatures::Feature& a : of_a)
    for (const MovingFeatures::Feature& b : of_b)
      if (first_meeting(a.box, b.box) <= last_time) test(a.index, b.index);
}

void LeafSweep::test_vertex_face(std::uint32_t vertex, std::uint32_t face, bool is_vertex_of_a) {
  const FeatureRef point{FeatureRefKind::vertex, vertex};
  const FeatureRef area{FeatureRefKind::face, face};
  if (!(is_vertex_of_a ? may(point, area) : may(area, point))) return;
  const MovingSurface& of_point = is_vertex_of_a ? a_ : b_;
  const MovingSurface& of_area = is_vertex_of_a ? b_ : a_;
  const auto corners = of_area.mesh().face(face);
  if (query_.is_self && has(corners, vertex)) return;
  ++work_.feature_pairs_tested;
  std::optional<SweptMeeting> meeting;
  for (std::size_t last = 2; last < corners.size(); ++last) {
    const FeatureSweep sweep =
        sweep_of(of_point, vertex, of_area, {corners[0], corners[last - 1], corners[last]});
    join(meeting, meet_vertex_face(sweep, query_.precision, work_.features));
    if (query_.gap > 0) note_gap(approach_vertex_face(sweep, query_.gap));
  }
  if (!meeting) return;
  Impact impact{ContactKind::VF, {FeatureKind::vertex, vertex}, {FeatureKind::face, face}};
  // One surface with itself has the lower feature first, which is the vertex.
  if (!is_vertex_of_a && !query_.is_self) std::swap(impact.feature_a, impact.feature_b);
  impact.lower = meeting->lower;
  impact.upper = meeting->upper;
  impact.status = meeting->status;
  list(impact);
}

void LeafSweep::test_edges(std::uint32_t edge_a, std::uint32_t edge_b) {
  if (!may({FeatureRefKind::edge, edge_a}, {FeatureRefKind::edge, edge_b})) return;
  if (query_.is_self && edge_b < edge_a) std::swap(edge_a, edge_b);
  const auto ends_a = a_.mesh().edge(edge_a);
  const auto ends_b = b_.mesh().edge(edge_b);
  if (query_.is_self && (has(ends_b, ends_a[0]) || has(ends_b, ends_a[1]))) return;
  ++work_.feature_pairs_tested;
  FeatureSweep sweep;
  for (std::size_t i = 0; i < 2; ++i) {
    sweep.start[i] = a_.at_start(ends_a[i]);
    sweep.end[i] = a_.at_end(ends_a[i]);
    sweep.start[i + 2] = b_.at_start(ends_b[i]);
    sweep.end[i + 2] = b_.at_end(ends_b[i]);
  }
  if (query_.gap > 0) note_gap(approach_edge_edge(sweep, query_.gap));
  const auto meeting = meet_edge_edge(sweep, query_.precision, work_.features);
  if (!meeting) return;
  list({ContactKind::EE,
        {FeatureKind::edge, edge_a},
        {FeatureKind::edge, edge_b},
        meeting->lower,
        meeting->upper,
        meeting->status});
}

void LeafSweep::note_gap(const std::optional<double>& time) {
  if (time) answer_.time_of_gap = std::min(answer_.time_of_gap, *time);
}

void LeafSweep::list(const Impact& impact) {
  answer_.impacts.push_back(impact);
  answer_.time_of_impact = std::min(answer_.time_of_impact, impact.lower);
}

}  // namespace graze
