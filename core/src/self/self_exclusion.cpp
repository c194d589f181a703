#include "core/self/self_exclusion.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "closest_features/feature_pair_key.hpp"

namespace graze {
namespace {

/// The vertices of a feature. `room` is for those that the mesh does not list. A fold has those of its quad.
std::span<const std::uint32_t> vertices_of(const IndexedMesh& mesh, const FeatureRef& feature,
                                           std::array<std::uint32_t, 2>& room) {
  if (feature.kind == FeatureRefKind::face || feature.kind == FeatureRefKind::fold)
    return mesh.face(feature.index);
  room = feature.kind == FeatureRefKind::edge ? mesh.edge(feature.index)
                                              : std::array{feature.index, feature.index};
  return std::span(room).first(feature.kind == FeatureRefKind::edge ? 2 : 1);
}

/// Whether `holds(vertex of a, vertex of b)` for some vertices of two features.
template <typename Holds>
bool any_vertices(const IndexedMesh& mesh, const FeatureRef& a, const FeatureRef& b, const Holds& holds) {
  std::array<std::uint32_t, 2> room_a;
  std::array<std::uint32_t, 2> room_b;
  const auto of_b = vertices_of(mesh, b, room_b);
  for (const std::uint32_t one : vertices_of(mesh, a, room_a))
    for (const std::uint32_t other : of_b)
      if (holds(one, other)) return true;
  return false;
}

/// Asks how near features of one surface are, each two of them by a vertex and a face, or two edges.
class RestDistance {
 public:
  RestDistance(const Surface& rest, double distance) : pair_{rest, rest, count_}, distance_(distance) {}

  [[nodiscard]] bool is_below(const FeatureRef& a, const FeatureRef& b) {
    if (a.kind == FeatureRefKind::vertex && b.kind == FeatureRefKind::vertex)
      return is_closer_than(pair_, FeaturePairKey::of(vertex_piece(a.index), vertex_piece(b.index)),
                            distance_);
    if (a.kind > b.kind) return is_below(b, a);
    if (a.kind == FeatureRefKind::vertex) return is_vertex_below(a.index, b);
    return is_edge_or_face_below(a, b);
  }

 private:
  bool is_vertex_below(std::uint32_t vertex, const FeatureRef& other) {
    const Eigen::Vector3d point = pair_.a.position(vertex);
    SquaredRange squared;
    const FeaturePiece piece =
        other.kind == FeatureRefKind::edge
            ? nearest_piece_of_segment(point, pair_.b, edge_piece(other.index), count_)
            : nearest_piece_of_face(point, pair_.b, other.index, count_, squared);
    return is_closer_than(pair_, FeaturePairKey::of(vertex_piece(vertex), piece), squared, distance_);
  }
  bool are_edges_below(std::uint32_t a, std::uint32_t b) {
    SquaredRange squared;
    const ClosestPiecesOfSegments found =
        nearest_pieces_of_segments(pair_.a, edge_piece(a), pair_.b, edge_piece(b), count_, squared);
    return is_closer_than(pair_, FeaturePairKey::of(found.pieces[0][0], found.pieces[0][1]), squared,
                          distance_);
  }
  /// Two edges, or features of which one is a face: the distance is that of a vertex or edge of one from the
  /// other, unless an edge pierces a face.
  bool is_edge_or_face_below(const FeatureRef& a, const FeatureRef& b) {
    if (b.kind == FeatureRefKind::edge) return are_edges_below(a.index, b.index);
    return is_part_below(a, b) || is_part_below(b, a) || are_sides_below(a, b);
  }
  bool is_part_below(const FeatureRef& corners_of, const FeatureRef& other) {
    std::array<std::uint32_t, 2> room;
    const auto corners = vertices_of(pair_.a.mesh(), corners_of, room);
    return std::any_of(corners.begin(), corners.end(),
                       [&](std::uint32_t vertex) { return is_vertex_below(vertex, other); });
  }
  bool are_sides_below(const FeatureRef& a, const FeatureRef& b) {
    for (const std::uint32_t of_a : sides_of(a))
      for (const std::uint32_t of_b : sides_of(b))
        if (of_a != IndexedMesh::no_edge && of_b != IndexedMesh::no_edge && are_edges_below(of_a, of_b))
          return true;
    return false;
  }
  static std::span<const std::uint32_t> edge_itself(const FeatureRef& edge) { return {&edge.index, 1}; }
  [[nodiscard]] std::span<const std::uint32_t> sides_of(const FeatureRef& feature) const {
    return feature.kind == FeatureRefKind::edge ? edge_itself(feature)
                                                : pair_.a.mesh().face_edges(feature.index);
  }

  DecisionCount count_;
  SurfacePair pair_;
  double distance_;
};

}  // namespace

SelfExclusion::SelfExclusion(std::shared_ptr<const IndexedMesh> mesh, std::uint32_t rings)
    : rest_(std::move(mesh)), rings_(rings) {
  rest_.mesh().prepare_for(IndexedMesh::Use::neighbours);
  rest_.mesh().prepare_for(IndexedMesh::Use::normals_of_points);
  find_far_pairs();
}

bool SelfExclusion::share_vertex(const FeatureRef& a, const FeatureRef& b) const {
  return any_vertices(mesh(), a, b, [](std::uint32_t one, std::uint32_t other) { return one == other; });
}

bool SelfExclusion::are_neighbours(const FeatureRef& a, const FeatureRef& b) const {
  return any_vertices(mesh(), a, b, [this](std::uint32_t one, std::uint32_t other) {
    return are_joined(one, other, rings_);
  });
}

bool SelfExclusion::are_near_at_rest(const FeatureRef& a, const FeatureRef& b, double distance) const {
  return RestDistance(rest_, distance).is_below(a, b);
}

/// Whether so many edges or fewer lead from one vertex to the other. It goes on from the vertex with fewer
/// neighbours.
bool SelfExclusion::are_joined(std::uint32_t one, std::uint32_t other, std::uint32_t edges) const {
  if (one == other) return true;
  if (edges == 0) return false;
  auto neighbours = mesh().vertex_neighbours(one);
  if (const auto of_other = mesh().vertex_neighbours(other); of_other.size() < neighbours.size()) {
    neighbours = of_other;
    other = one;
  }
  if (std::binary_search(neighbours.begin(), neighbours.end(), other)) return true;
  return edges > 1 && std::any_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t next) {
           return are_joined(next, other, edges - 1);
         });
}

void SelfExclusion::find_far_pairs() {
  const auto used = mesh().regions().vertices();
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [&](std::uint32_t left, std::uint32_t right) {
      return rest_.position(left)[axis] < rest_.position(right)[axis];
    };
    const auto [least, most] = std::minmax_element(used.begin(), used.end(), along);
    far_pairs_[static_cast<std::size_t>(axis)] = {*least, mesh().vertex_faces(*most).front()};
  }
}

}  // namespace graze
