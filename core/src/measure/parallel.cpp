#include "measure/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <utility>

#include "base/inplace_vector.hpp"
#include "closest_features/overlap.hpp"
#include "core/mesh/pair_room.hpp"
#include "measure/measure.hpp"

namespace graze {
namespace {

/// How many answers about pairs of faces are kept.
constexpr std::size_t known_count = 1024;

// A direction with the square of its length, were the corners square.
std::array<double, 4> direction_of_edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  return {along.x(), along.y(), along.z(), along.squaredNorm()};
}
std::array<double, 4> normal_of_triangle(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                                         const Eigen::Vector3d& third) {
  const Eigen::Vector3d u = second - first;
  const Eigen::Vector3d v = third - first;
  const Eigen::Vector3d normal = u.cross(v);
  return {normal.x(), normal.y(), normal.z(), u.squaredNorm() * v.squaredNorm()};
}
std::array<double, 4> normal_of_triangle(const Simplex& triangle) {
  return normal_of_triangle(triangle.point[0], triangle.point[1], triangle.point[2]);
}

/// The error of plain double is below 2^-49 of the sizes. Edges or faces that are further from parallel than
/// this are certainly not parallel. Products that underflow decide nothing.
constexpr double least_angle_squared = 0x1p-80;
constexpr double least_product = 0x1p-900;

/// Whether two edges or two faces are certainly not parallel, or an edge and a face, if not
/// `are_of_one_kind`.
template <bool are_of_one_kind>
bool are_certainly_apart(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double squared = 0;
  if constexpr (are_of_one_kind) {
    const double x = a[1] * b[2] - a[2] * b[1];
    const double y = a[2] * b[0] - a[0] * b[2];
    const double z = a[0] * b[1] - a[1] * b[0];
    squared = x * x + y * y + z * z;
  } else {
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    squared = along * along;
  }
  const double sizes = a[3] * b[3];
  return sizes > least_product && squared > least_angle_squared * sizes;
}

/// Calls `use(i, j)` with the places of two holders that may be parallel, by plain double, until it returns
/// true. A quad comes once for each two triangles that may be.
template <bool are_of_one_kind, typename Use>
bool any_that_may(const std::vector<Holder>& a, const std::vector<Holder>& b, const Use& use) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (!are_certainly_apart<are_of_one_kind>(a[i].direction, b[j].direction) && use(i, j)) return true;
  return false;
}

/// Which of the faces that hold a key are parallel contacts, and which faces an edge that holds it has. Both
/// are sets of places in the lists of holders.
class ParallelFaces {
 public:
  /// Whether all holders of a key can be told apart.
  static bool can_hold(const Holders& a, const Holders& b) {
    return std::max({a.edges.size(), a.faces.size(), b.edges.size(), b.faces.size()}) <= most;
  }
  void begin(const Holders& a) { std::fill_n(beside_face_.begin(), a.faces.size(), 0); }
  void add(std::size_t face_a, std::size_t face_b) { beside_face_[face_a] |= std::uint64_t{1} << face_b; }
  /// Call it when all faces are added.
  void end(const SurfacePair& pair, const Holders& a, const Holders& b) {
    for (std::size_t i = 0; i < a.edges.size(); ++i) {
      beside_edge_[i] = 0;
      for (std::uint64_t left = faces_of(pair.a.mesh(), a, i); left != 0; left &= left - 1)
        beside_edge_[i] |= beside_face_[static_cast<std::size_t>(std::countr_zero(left))];
    }
    for (std::size_t i = 0; i < b.edges.size(); ++i) faces_of_edge_b_[i] = faces_of(pair.b.mesh(), b, i);
  }
  // Whether faces that hold two features, of which one is an edge at least, are parallel contacts.
  [[nodiscard]] bool hold_edge_and_face(std::size_t a, std::size_t b) const {
    return (beside_edge_[a] >> b & 1U) != 0;
  }
  [[nodiscard]] bool hold_face_and_edge(std::size_t a, std::size_t b) const {
    return (beside_face_[a] & faces_of_edge_b_[b]) != 0;
  }
  [[nodiscard]] bool hold_edges(std::size_t a, std::size_t b) const {
    return (beside_edge_[a] & faces_of_edge_b_[b]) != 0;
  }

 private:
  static constexpr std::size_t most = 64;
  using Sets = std::array<std::uint64_t, most>;

  static std::uint64_t faces_of(const IndexedMesh& mesh, const Holders& holders, std::size_t edge) {
    std::uint64_t faces = 0;
    for (const std::uint32_t face : mesh.edge_faces(holders.edges[edge].feature))
      for (std::size_t i = 0; i < holders.faces.size(); ++i)
        faces |= std::uint64_t{holders.faces[i].feature == face ? 1U : 0U} << i;
    return faces;
  }

  Sets beside_face_;      ///< by face of a: those of b
  Sets beside_edge_;      ///< by edge of a: the faces of b that are beside a face of the edge
  Sets faces_of_edge_b_;  ///< by edge of b
};

FeatureRef ref_of(const Feature& feature) {
  return {feature.kind == FeatureKind::edge ? FeatureRefKind::edge : FeatureRefKind::face, feature.index};
}

/// The flat pieces of an edge or face that can be parallel to another's, and which of their sides is the
/// fold.
struct SidedPiece {
  FeaturePiece piece;
  std::size_t fold_side = 3;
};

InplaceVector<SidedPiece, 2> pieces_of(const Surface& surface, const Feature& feature) {
  InplaceVector<SidedPiece, 2> pieces;
  if (feature.kind == FeatureKind::edge) {
    pieces.push_back({edge_piece(feature.index), 3});
  } else if (triangle_count(surface.mesh(), feature.index) == 1) {
    pieces.push_back({face_piece(feature.index, Piece::first), 3});
  } else {
    // The border between a quad's triangles is inside it.
    const bool has_inner_border =
        diagonal_of(surface.mesh(), feature.index).feature.kind == FeatureKind::face;
    pieces.push_back({face_piece(feature.index, Piece::first), has_inner_border ? 2U : 3U});
    pieces.push_back({face_piece(feature.index, Piece::second), has_inner_border ? 0U : 3U});
  }
  return pieces;
}

/// Features that are parallel to each other and have a stretch or an area of closest points. Among all that
/// hold the keys at the least distance, asks which are, and which of keys and of these gives way to others
/// of these.
class ParallelContacts {
 public:
  ParallelContacts(const SurfacePair& pair, const FeaturePairKey& nearest, ParallelScratch& scratch)
      : pair_(pair),
        nearest_(nearest),
        touches_(nearest.meeting() == Meeting::pierced || do_touch(hulls_of(pair, nearest), pair.count)),
        scratch_(scratch) {
    scratch_.known.resize(known_count);
    if (++scratch_.query == 0) {  // numbers begin anew
      scratch_.known.assign(known_count, {});
      scratch_.query = 1;
    }
  }

  /// Returns whether a parallel contact holds both features of a key, which gives way to it then. Those that
  /// do are offered. Faces come first: most edges give way to them.
  bool take(const FeaturePairKey& key) {
    find(key);
    const Holders& a = scratch_.of_key_a;
    const Holders& b = scratch_.of_key_b;
    const bool can_hold = ParallelFaces::can_hold(a, b);
    bool gives_way = false;
    if (can_hold) faces_.begin(a);
    any_that_may<true>(a.faces, b.faces, [&](std::size_t i, std::size_t j) {
      const TwoFeatures features{face(a, i), face(b, j)};
      if (!is_parallel(features)) return false;
      gives_way = true;
      if (can_hold) faces_.add(i, j);
      offer(features);
      return false;
    });
    const bool is_known = can_hold && gives_way;  // which edges give way to faces
    const bool is_asked = !can_hold && gives_way;
    if (is_known) faces_.end(pair_, a, b);
    const auto take_one = [&](const TwoFeatures& features, bool gives_way_to_known) {
      if (gives_way_to_known || (is_asked && gives_way_to_faces(features))) return;
      if (!is_parallel(features)) return;
      gives_way = true;
      offer(features);
    };
    any_that_may<false>(a.faces, b.edges, [&](std::size_t i, std::size_t j) {
      take_one({face(a, i), edge(b, j)}, is_known && faces_.hold_face_and_edge(i, j));
      return false;
    });
    any_that_may<false>(a.edges, b.faces, [&](std::size_t i, std::size_t j) {
      take_one({edge(a, i), face(b, j)}, is_known && faces_.hold_edge_and_face(i, j));
      return false;
    });
    any_that_may<true>(a.edges, b.edges, [&](std::size_t i, std::size_t j) {
      take_one({edge(a, i), edge(b, j)}, is_known && faces_.hold_edges(i, j));
      return false;
    });
    return gives_way;
  }

  /// The lowest of those offered that gives way to no other and comes before `end`, if there is one, with its
  /// middle.
  [[nodiscard]] std::optional<Contact> lowest(const FeaturePairKey* end) {
    const bool is_before_end = found_ && (end == nullptr || *lowest_ < *end);
    return is_before_end ? std::optional(contact_of(*found_)) : std::nullopt;
  }

 private:
  void find(const FeaturePairKey& key) {
    constexpr std::uint32_t pieces =
        8;  // some hundred pairs of holders, most of which are apart at first sight
    pair_.check_time(pieces);
    scratch_.of_key_a.find(pair_.a, key.a().feature);
    scratch_.of_key_b.find(pair_.b, key.b().feature);
  }

  static Feature face(const Holders& holders, std::size_t i) {
    return {FeatureKind::face, holders.faces[i].feature};
  }
  static Feature edge(const Holders& holders, std::size_t i) {
    return {FeatureKind::edge, holders.edges[i].feature};
  }

  /// Whether a parallel contact is among the pairs of holders, other than `itself`.
  bool any_parallel(const Holders& a, const Holders& b, const TwoFeatures& itself) {
    const auto is_another = [&](const TwoFeatures& features) {
      return features != itself && is_parallel(features);
    };
    return any_that_may<true>(a.faces, b.faces,
                              [&](auto i, auto j) {
                                return is_another({face(a, i), face(b, j)});
                              }) ||
           any_that_may<false>(a.faces, b.edges,
                               [&](auto i, auto j) {
                                 return is_another({face(a, i), edge(b, j)});
                               }) ||
           any_that_may<false>(a.edges, b.faces,
                               [&](auto i, auto j) {
                                 return is_another({edge(a, i), face(b, j)});
                               }) ||
           any_that_may<true>(a.edges, b.edges, [&](auto i, auto j) {
             return is_another({edge(a, i), edge(b, j)});
           });
  }

  /// Takes parallel features if they are the lowest that give way to no others. Those of one surface are
  /// known by the lower first, as keys are.
  void offer(const TwoFeatures& offered) {
    const bool is_in_order = !pair_.is_of_self() || offered.first <= offered.second;
    const TwoFeatures features = is_in_order ? offered : TwoFeatures{offered.second, offered.first};
    const auto& [a, b] = features;
    const FeaturePairKey key = FeaturePairKey::of({a, Piece::fold}, {b, Piece::fold}, Meeting::parallel);
    if (lowest_ && !(key < *lowest_)) return;
    scratch_.above_a.find(pair_.a, a);
    scratch_.above_b.find(pair_.b, b);
    if (any_parallel(scratch_.above_a, scratch_.above_b, features)) return;
    lowest_ = key;
    found_ = features;
  }
  bool gives_way_to_faces(const TwoFeatures& features) {
    for (const std::uint32_t of_a : faces_of(pair_.a.mesh(), features.first))
      for (const std::uint32_t of_b : faces_of(pair_.b.mesh(), features.second))
        if (is_parallel({{FeatureKind::face, of_a}, {FeatureKind::face, of_b}})) return true;
    return false;
  }
  /// The faces of an edge, or a face itself. The span refers to the mesh or to `feature`.
  static std::span<const std::uint32_t> faces_of(const IndexedMesh& mesh, const Feature& feature) {
    if (feature.kind == FeatureKind::face) return {&feature.index, 1};
    return mesh.edge_faces(feature.index);
  }

  /// Whether two edges or faces have a stretch or an area of closest points at the least distance, and may be
  /// looked at.
  bool is_parallel(const TwoFeatures& features) {
    const auto& [a, b] = features;
    if (pair_.groups != nullptr && !pair_.groups->may(ref_of(a), ref_of(b))) return false;
    if (a.kind != FeatureKind::face || b.kind != FeatureKind::face) return decide_parallel(features);
    ParallelScratch::Known& known =
        scratch_.known[(a.index * std::size_t{0x9e3779b1} + b.index) % known_count];
    if (known.query != scratch_.query || known.faces != features)
      known = {features, scratch_.query, decide_parallel(features)};
    return known.are_parallel;
  }
  bool decide_parallel(const TwoFeatures& features) {
    bool found = false;
    for_each_part(features,
                  [&](const FeaturePairKey&, const Simplex&, const Simplex&) { return found = true; });
    return found;
  }

  /// Calls `use` with the pieces of two features that are parallel contacts, until it returns true.
  template <typename Use>
  void for_each_part(const TwoFeatures& features, const Use& use) {
    for (const SidedPiece& of_a : pieces_of(pair_.a, features.first))
      for (const SidedPiece& of_b : pieces_of(pair_.b, features.second)) {
        const Simplex a = simplex_of(pair_.a, of_a.piece);
        const Simplex b = simplex_of(pair_.b, of_b.piece);
        const bool are_triangles = a.size == 3 && b.size == 3;
        if (are_triangles && are_certainly_apart<true>(normal_of_triangle(a), normal_of_triangle(b)))
          continue;
        if (!do_overlap(a, of_a.fold_side, b, of_b.fold_side, pair_.count)) continue;
        const FeaturePairKey key = FeaturePairKey::of(of_a.piece, of_b.piece, Meeting::parallel);
        // One triangle of a bent quad may be parallel and further than the other.
        if (is_nearest(key, a, b) && use(key, a, b)) return;
      }
  }
  [[nodiscard]] bool is_nearest(const FeaturePairKey& key, const Simplex& a, const Simplex& b) const {
    if (!touches_) return compare_distances(pair_, key, nearest_) == 0;
    for (std::uint32_t i = 0; i < a.size; ++i)
      for (std::uint32_t j = 0; j < b.size; ++j)
        if (a.point[i] == b.point[j]) return true;
    return do_touch(hulls_of(pair_, key), pair_.count);
  }

  [[nodiscard]] Contact contact_of(const TwoFeatures& features) {
    const LocalFrame frame(pair_.a, features.first, pair_.b, features.second);
    std::optional<FeaturePairKey> first_key;
    Overlaps overlaps;
    for_each_part(features, [&](const FeaturePairKey& key, const Simplex& a, const Simplex& b) {
      if (!first_key) first_key = key;
      overlaps.push_back(overlap_of(a, b, frame, pair_.count));
      return false;
    });
    const Overlap largest = largest_part(overlaps);
    return measure_parallel(pair_, *first_key, frame.to_world(largest.middle_a),
                            frame.to_world(largest.middle_b));
  }

  const SurfacePair& pair_;
  const FeaturePairKey& nearest_;
  bool touches_;  ///< the least distance is 0
  ParallelScratch& scratch_;
  ParallelFaces faces_;                   ///< of the present key
  std::optional<FeaturePairKey> lowest_;  ///< only keys below this are still searched for
  std::optional<TwoFeatures> found_;
};

}  // namespace

void Holders::find(const Surface& surface, const Feature& feature) {
  edges.clear();
  faces.clear();
  const IndexedMesh& mesh = surface.mesh();
  if (feature.kind == FeatureKind::face) {
    add_face(surface, feature.index);
  } else if (feature.kind == FeatureKind::edge) {
    add_edge(surface, feature.index);
    for (const std::uint32_t face : mesh.edge_faces(feature.index)) add_face(surface, face);
  } else {
    for (const std::uint32_t face : mesh.vertex_faces(feature.index)) {
      add_face(surface, face);
      for (const std::uint32_t edge : mesh.face_edges(face)) {
        if (edge == IndexedMesh::no_edge) continue;
        const auto [first, second] = mesh.edge(edge);
        const bool has_vertex = first == feature.index || second == feature.index;
        // An edge is taken with the first of its faces.
        if (has_vertex && mesh.edge_faces(edge).front() == face) add_edge(surface, edge);
      }
    }
  }
}

void Holders::reserve(const PairRoom& room) {
  edges.reserve(room.ties);
  faces.reserve(room.ties);
}

void Holders::add_edge(const Surface& surface, std::uint32_t edge) {
  const auto [first, second] = surface.mesh().edge(edge);
  edges.push_back({edge, direction_of_edge(surface.position(first), surface.position(second))});
}

void Holders::add_face(const Surface& surface, std::uint32_t face) {
  const auto corner = surface.mesh().face(face);
  const Eigen::Vector3d first = surface.position(corner[0]);
  for (std::size_t last = 2; last < corner.size(); ++last)
    faces.push_back({face, normal_of_triangle(first, surface.position(corner[last - 1]),
                                              surface.position(corner[last]))});
}

void ParallelScratch::reserve(const PairRoom& room) {
  for (Holders* const holders : {&of_key_a, &of_key_b, &above_a, &above_b}) holders->reserve(room);
  known.reserve(known_count);
}

Contact closest_contact(const SurfacePair& pair, const std::vector<FeaturePairKey>& keys,
                        ParallelScratch& scratch) {
  ParallelContacts parallel(pair, keys.front(), scratch);
  const FeaturePairKey* lowest = nullptr;
  for (const FeaturePairKey& key : keys) {
    if (parallel.take(key) || lowest != nullptr) continue;
    lowest = &key;
    // Parallel are edges and faces alone.
    if (key.kind() < ContactKind::EE) break;
  }
  if (const auto contact = parallel.lowest(lowest)) return *contact;
  return measure(pair, lowest == nullptr ? keys.front() : *lowest);
}

}  // namespace graze
