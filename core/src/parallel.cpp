#include "parallel.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "measure.hpp"
#include "overlap.hpp"

namespace graze {
namespace {

using FeaturePair = std::pair<Feature, Feature>;

/// The edges and faces that hold a feature, itself included.
std::vector<Feature> holders_of(const Mesh& mesh, const Feature& feature) {
  std::vector<Feature> holders;
  const auto add_face = [&](std::uint32_t face) { holders.push_back({FeatureKind::face, face}); };
  if (feature.kind == FeatureKind::face) {
    add_face(feature.index);
  } else if (feature.kind == FeatureKind::edge) {
    holders.push_back(feature);
    for (const std::uint32_t face : mesh.edge_faces(feature.index)) add_face(face);
  } else {
    for (const std::uint32_t face : mesh.vertex_faces(feature.index)) {
      add_face(face);
      for (const std::uint32_t edge : mesh.face_edges(face))
        if (edge != Mesh::no_edge &&
            (mesh.edge(edge)[0] == feature.index || mesh.edge(edge)[1] == feature.index))
          holders.push_back({FeatureKind::edge, edge});
    }
  }
  return holders;
}

std::vector<FeaturePair> holders_of(const SurfacePair& pair, const ContactName& name) {
  std::vector<FeaturePair> pairs;
  const std::vector<Feature> holders_b = holders_of(pair.b.mesh(), name.b.feature);
  for (const Feature& a : holders_of(pair.a.mesh(), name.a.feature))
    for (const Feature& b : holders_b) pairs.emplace_back(a, b);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The flat pieces of an edge or face that can be parallel to another's, and which of their sides is the
/// fold.
struct SidedPiece {
  FeaturePiece piece;
  std::size_t fold_side = 3;
};

std::vector<SidedPiece> pieces_of(const Surface& surface, const Feature& feature) {
  if (feature.kind == FeatureKind::edge) return {{edge_piece(feature.index), 3}};
  if (triangle_count(surface.mesh(), feature.index) == 1)
    return {{face_piece(feature.index, Piece::first), 3}};
  // The border between a quad's triangles is inside it.
  const bool has_inner_border = diagonal_of(surface.mesh(), feature.index).feature.kind == FeatureKind::face;
  return {{face_piece(feature.index, Piece::first), has_inner_border ? 2U : 3U},
          {face_piece(feature.index, Piece::second), has_inner_border ? 0U : 3U}};
}

/// A parallel pair of features and the middle of its closest set.
struct ParallelContact {
  ContactName name;
  Eigen::Vector3d middle_a;
  Eigen::Vector3d middle_b;
};

/// The closest set of two features that hold closest points, where it has a length or an area.
std::optional<ParallelContact> parallel_contact(const SurfacePair& pair, const FeaturePair& features,
                                                const ContactName& nearest) {
  const LocalFrame frame(pair.a, features.first, pair.b, features.second);
  std::vector<ContactName> names;
  std::vector<Overlap> overlaps;
  for (const SidedPiece& a : pieces_of(pair.a, features.first))
    for (const SidedPiece& b : pieces_of(pair.b, features.second)) {
      auto overlap = overlap_of(simplex_of(pair.a, a.piece), a.fold_side, simplex_of(pair.b, b.piece),
                                b.fold_side, frame, pair.count);
      if (!overlap) continue;
      const ContactName name = ContactName::of(a.piece, b.piece, Meeting::parallel);
      // One triangle of a bent quad may be parallel and further than the other.
      if (compare_distances(pair, name, nearest) != 0) continue;
      names.push_back(name);
      overlaps.push_back(std::move(*overlap));
    }
  if (names.empty()) return std::nullopt;
  const Overlap largest = largest_part(overlaps);
  return ParallelContact{names.front(), frame.to_world(largest.middle_a), frame.to_world(largest.middle_b)};
}

bool by_name(const ParallelContact& left, const ParallelContact& right) {
  return left.name < right.name;
}

std::vector<ParallelContact> parallel_contacts(const SurfacePair& pair,
                                               const std::vector<ContactName>& names) {
  std::vector<FeaturePair> candidates;
  for (const ContactName& name : names) {
    const std::vector<FeaturePair> holders = holders_of(pair, name);
    candidates.insert(candidates.end(), holders.begin(), holders.end());
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::vector<ParallelContact> found;
  for (const FeaturePair& features : candidates)
    if (auto contact = parallel_contact(pair, features, names.front())) found.push_back(*contact);
  std::sort(found.begin(), found.end(), by_name);
  return found;
}

/// Whether a parallel pair other than itself holds both features of `name`.
bool gives_way(const SurfacePair& pair, const ContactName& name,
               const std::vector<ParallelContact>& parallel) {
  const FeaturePair self{name.a.feature, name.b.feature};
  const std::vector<FeaturePair> holders = holders_of(pair, name);
  return std::any_of(parallel.begin(), parallel.end(), [&](const ParallelContact& contact) {
    const FeaturePair features{contact.name.a.feature, contact.name.b.feature};
    return (features != self || name.meeting != Meeting::parallel) &&
           std::binary_search(holders.begin(), holders.end(), features);
  });
}

}  // namespace

Contact closest_contact(const SurfacePair& pair, const std::vector<ContactName>& names) {
  const std::vector<ParallelContact> parallel = parallel_contacts(pair, names);
  const auto lowest_name = std::find_if(
      names.begin(), names.end(), [&](const ContactName& name) { return !gives_way(pair, name, parallel); });
  const auto lowest_parallel =
      std::find_if(parallel.begin(), parallel.end(),
                   [&](const ParallelContact& contact) { return !gives_way(pair, contact.name, parallel); });
  const bool is_parallel = lowest_name == names.end() ||
                           (lowest_parallel != parallel.end() && lowest_parallel->name < *lowest_name);
  if (!is_parallel) return measure(pair, *lowest_name);
  return measure_parallel(pair, lowest_parallel->name, lowest_parallel->middle_a, lowest_parallel->middle_b);
}

}  // namespace graze
