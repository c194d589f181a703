#include "parallel.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "measure.hpp"
#include "overlap.hpp"

namespace graze {
namespace {

/// The edges and faces that hold a feature, itself included.
void find_holders(const Mesh& mesh, const Feature& feature, std::vector<Feature>& holders) {
  holders.clear();
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
}

/// The pairs of features that hold those of a name; in scratch.holders.
void find_holders(const SurfacePair& pair, const ContactName& name, ParallelScratch& scratch) {
  find_holders(pair.a.mesh(), name.a().feature, scratch.holders_a);
  find_holders(pair.b.mesh(), name.b().feature, scratch.holders_b);
  scratch.holders.clear();
  for (const Feature& a : scratch.holders_a)
    for (const Feature& b : scratch.holders_b) scratch.holders.emplace_back(a, b);
  std::sort(scratch.holders.begin(), scratch.holders.end());
  scratch.holders.erase(std::unique(scratch.holders.begin(), scratch.holders.end()), scratch.holders.end());
}

/// The flat pieces of an edge or face that can be parallel to another's, and which of their sides is the
/// fold.
struct SidedPiece {
  FeaturePiece piece;
  std::size_t fold_side = 3;
};

Few<SidedPiece, 2> pieces_of(const Surface& surface, const Feature& feature) {
  Few<SidedPiece, 2> pieces;
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

/// The closest set of two features that hold closest points, where it has a length or an area.
std::optional<ParallelContact> parallel_contact(const SurfacePair& pair, const FeaturePair& features,
                                                const ContactName& nearest) {
  const LocalFrame frame(pair.a, features.first, pair.b, features.second);
  std::optional<ContactName> first_name;
  Overlaps overlaps;
  for (const SidedPiece& a : pieces_of(pair.a, features.first))
    for (const SidedPiece& b : pieces_of(pair.b, features.second)) {
      const auto overlap = overlap_of(simplex_of(pair.a, a.piece), a.fold_side, simplex_of(pair.b, b.piece),
                                      b.fold_side, frame, pair.count);
      if (!overlap) continue;
      const ContactName name = ContactName::of(a.piece, b.piece, Meeting::parallel);
      // One triangle of a bent quad may be parallel and further than the other.
      if (compare_distances(pair, name, nearest) != 0) continue;
      if (!first_name) first_name = name;
      overlaps.push_back(*overlap);
    }
  if (!first_name) return std::nullopt;
  const Overlap largest = largest_part(overlaps);
  return ParallelContact{*first_name, frame.to_world(largest.middle_a), frame.to_world(largest.middle_b)};
}

bool by_name(const ParallelContact& left, const ParallelContact& right) {
  return left.name < right.name;
}

/// Into scratch.found, sorted by name.
void find_parallel_contacts(const SurfacePair& pair, const std::vector<ContactName>& names,
                            ParallelScratch& scratch) {
  auto& candidates = scratch.candidates;
  candidates.clear();
  for (const ContactName& name : names) {
    find_holders(pair, name, scratch);
    candidates.insert(candidates.end(), scratch.holders.begin(), scratch.holders.end());
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  scratch.found.clear();
  for (const FeaturePair& features : candidates)
    if (auto contact = parallel_contact(pair, features, names.front())) scratch.found.push_back(*contact);
  std::sort(scratch.found.begin(), scratch.found.end(), by_name);
}

/// Whether a parallel pair of scratch.found, other than itself, holds both features of `name`.
bool gives_way(const SurfacePair& pair, const ContactName& name, ParallelScratch& scratch) {
  const FeaturePair self{name.a().feature, name.b().feature};
  find_holders(pair, name, scratch);
  return std::any_of(scratch.found.begin(), scratch.found.end(), [&](const ParallelContact& contact) {
    const FeaturePair features{contact.name.a().feature, contact.name.b().feature};
    return (features != self || name.meeting() != Meeting::parallel) &&
           std::binary_search(scratch.holders.begin(), scratch.holders.end(), features);
  });
}

}  // namespace

Contact closest_contact(const SurfacePair& pair, const std::vector<ContactName>& names,
                        ParallelScratch& scratch) {
  find_parallel_contacts(pair, names, scratch);
  const auto& parallel = scratch.found;
  const auto lowest_name = std::find_if(
      names.begin(), names.end(), [&](const ContactName& name) { return !gives_way(pair, name, scratch); });
  const auto lowest_parallel =
      std::find_if(parallel.begin(), parallel.end(),
                   [&](const ParallelContact& contact) { return !gives_way(pair, contact.name, scratch); });
  const bool is_parallel = lowest_name == names.end() ||
                           (lowest_parallel != parallel.end() && lowest_parallel->name < *lowest_name);
  if (!is_parallel) return measure(pair, *lowest_name);
  return measure_parallel(pair, lowest_parallel->name, lowest_parallel->middle_a, lowest_parallel->middle_b);
}

}  // namespace graze
