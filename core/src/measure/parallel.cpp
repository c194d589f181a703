#include "measure/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "closest_features/overlap.hpp"
#include "core/mesh/pair_room.hpp"
#include "measure/measure.hpp"

namespace graze {
namespace {

/// How many answers about pairs of faces are kept.
constexpr std::size_t known_count = 1024;

Holder::Direction normal_of(const Simplex& triangle) {
  const Eigen::Vector3d u = triangle.point[1] - triangle.point[0];
  const Eigen::Vector3d v = triangle.point[2] - triangle.point[0];
  return {u.cross(v), u.squaredNorm() * v.squaredNorm()};
}

Holder edge_holder(const Surface& surface, std::uint32_t edge) {
  const auto [first, second] = surface.mesh().edge(edge);
  const Eigen::Vector3d along = surface.position(second) - surface.position(first);
  Holder holder{{FeatureKind::edge, edge}, {}};
  holder.directions.push_back({along, along.squaredNorm()});
  return holder;
}

Holder face_holder(const Surface& surface, std::uint32_t face) {
  Holder holder{{FeatureKind::face, face}, {}};
  holder.directions.push_back(normal_of(simplex_of(surface, face_piece(face, Piece::first))));
  if (triangle_count(surface.mesh(), face) == 2)
    holder.directions.push_back(normal_of(simplex_of(surface, face_piece(face, Piece::second))));
  return holder;
}

/// The error of plain double is below 2^-49 of the sizes. Edges or faces that are further from parallel than
/// this are certainly not parallel. Products that underflow decide nothing.
constexpr double least_angle_squared = 0x1p-80;
constexpr double least_product = 0x1p-900;

bool are_certainly_across(double squared, double sizes) {
  return sizes > least_product && squared > least_angle_squared * sizes;
}
/// Whether two edges or two faces are certainly not parallel.
bool are_not_parallel(const Holder::Direction& a, const Holder::Direction& b) {
  return are_certainly_across(a.vector.cross(b.vector).squaredNorm(), a.largest_square * b.largest_square);
}
/// Whether an edge and a face are certainly not parallel.
bool are_not_square(const Holder::Direction& a, const Holder::Direction& b) {
  const double along = a.vector.dot(b.vector);
  return are_certainly_across(along * along, a.largest_square * b.largest_square);
}

/// Whether no parts of two holders are parallel, by plain double; false where that is not certain.
bool are_certainly_apart(const Holder& a, const Holder& b) {
  const auto test = a.feature.kind == b.feature.kind ? are_not_parallel : are_not_square;
  for (const Holder::Direction& of_a : a.directions)
    for (const Holder::Direction& of_b : b.directions)
      if (!test(of_a, of_b)) return false;
  return true;
}

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

  /// Whether a parallel contact holds both features of a key.
  [[nodiscard]] bool gives_way(const FeaturePairKey& key) {
    find(key);
    return any_parallel(scratch_.of_key_a, scratch_.of_key_b, nullptr);
  }

  /// The lowest that gives way to no other and comes before `end`, if there is one, with its middle.
  [[nodiscard]] std::optional<Contact> lowest(std::span<const FeaturePairKey> keys,
                                              const FeaturePairKey* end) {
    if (end != nullptr) lowest_ = *end;
    for (const FeaturePairKey& key : keys) {
      find(key);
      for_each_pair(scratch_.of_key_a, scratch_.of_key_b, [&](const Holder& a, const Holder& b) {
        offer(a, b);
        return false;
      });
    }
    return found_ ? std::optional(contact_of(*found_)) : std::nullopt;
  }

 private:
  void find(const FeaturePairKey& key) {
    constexpr std::uint32_t pieces =
        8;  // some hundred pairs of holders, most of which are apart at first sight
    pair_.check_time(pieces);
    scratch_.of_key_a.find(pair_.a, key.a().feature);
    scratch_.of_key_b.find(pair_.b, key.b().feature);
  }

  /// Calls `is_it(a, b)` with pairs of holders that may be parallel, faces first, until one is it.
  template <typename IsIt>
  static bool for_each_pair(const Holders& of_a, const Holders& of_b, const IsIt& is_it) {
    const auto any_of = [&](const std::vector<Holder>& all_a, const std::vector<Holder>& all_b) {
      for (const Holder& a : all_a)
        for (const Holder& b : all_b)
          if (!are_certainly_apart(a, b) && is_it(a, b)) return true;
      return false;
    };
    return any_of(of_a.faces, of_b.faces) || any_of(of_a.faces, of_b.edges) ||
           any_of(of_a.edges, of_b.faces) || any_of(of_a.edges, of_b.edges);
  }

  /// Whether a parallel contact is among the pairs of holders, other than `itself`.
  bool any_parallel(const Holders& of_a, const Holders& of_b, const TwoFeatures* itself) {
    return for_each_pair(of_a, of_b, [&](const Holder& a, const Holder& b) {
      const TwoFeatures features{a.feature, b.feature};
      return (itself == nullptr || features != *itself) && is_parallel(features);
    });
  }

  /// Takes a pair of holders if it is the lowest. Most give way to faces, which are tested first: an answer
  /// about two faces serves all edges around them.
  void offer(const Holder& a, const Holder& b) {
    const TwoFeatures features{a.feature, b.feature};
    const FeaturePairKey key =
        FeaturePairKey::of({a.feature, Piece::fold}, {b.feature, Piece::fold}, Meeting::parallel);
    if (lowest_ && !(key < *lowest_)) return;
    if (gives_way_to_faces(features) || !is_parallel(features)) return;
    scratch_.above_a.find(pair_.a, a.feature);
    scratch_.above_b.find(pair_.b, b.feature);
    if (any_parallel(scratch_.above_a, scratch_.above_b, &features)) return;
    lowest_ = key;
    found_ = features;
  }
  bool gives_way_to_faces(const TwoFeatures& features) {
    const auto is_face = [](const Feature& feature) { return feature.kind == FeatureKind::face; };
    if (is_face(features.first) && is_face(features.second)) return false;
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
  std::optional<FeaturePairKey> lowest_;  ///< only keys below this are still searched for
  std::optional<TwoFeatures> found_;
};

}  // namespace

void Holders::find(const Surface& surface, const Feature& feature) {
  const IndexedMesh& mesh = surface.mesh();
  features.clear();
  const auto add_face = [&](std::uint32_t face) { features.push_back({FeatureKind::face, face}); };
  if (feature.kind == FeatureKind::face) {
    add_face(feature.index);
  } else if (feature.kind == FeatureKind::edge) {
    features.push_back(feature);
    for (const std::uint32_t face : mesh.edge_faces(feature.index)) add_face(face);
  } else {
    for (const std::uint32_t face : mesh.vertex_faces(feature.index)) {
      add_face(face);
      for (const std::uint32_t edge : mesh.face_edges(face))
        if (edge != IndexedMesh::no_edge &&
            (mesh.edge(edge)[0] == feature.index || mesh.edge(edge)[1] == feature.index))
          features.push_back({FeatureKind::edge, edge});
    }
  }
  std::sort(features.begin(), features.end());
  features.erase(std::unique(features.begin(), features.end()), features.end());
  edges.clear();
  faces.clear();
  for (const Feature& holder : features)
    if (holder.kind == FeatureKind::edge)
      edges.push_back(edge_holder(surface, holder.index));
    else
      faces.push_back(face_holder(surface, holder.index));
}

void ParallelScratch::reserve(const PairRoom& room) {
  for (Holders* const holders : {&of_key_a, &of_key_b, &above_a, &above_b})
    std::apply([&](auto&... part) { (part.reserve(room.ties), ...); }, Holders::parts(*holders));
  known.reserve(known_count);
}

Contact closest_contact(const SurfacePair& pair, const std::vector<FeaturePairKey>& keys,
                        ParallelScratch& scratch) {
  ParallelContacts parallel(pair, keys.front(), scratch);
  const auto lowest_key = std::find_if(keys.begin(), keys.end(),
                                       [&](const FeaturePairKey& key) { return !parallel.gives_way(key); });
  const FeaturePairKey* const key = lowest_key == keys.end() ? nullptr : &*lowest_key;
  // Parallel are edges and faces alone.
  if (key != nullptr && key->kind() < ContactKind::EE) return measure(pair, *key);
  if (const auto contact = parallel.lowest(keys, key)) return *contact;
  return measure(pair, *key);
}

}  // namespace graze
