#pragma once

#include <graze/box.hpp>
#include <graze/region_tree.hpp>
#include <vector>

#include "bounds.hpp"
#include "contact_name.hpp"
#include "piercing.hpp"

namespace graze {

/// A feature and its box.
struct BoxedFeature {
  std::uint32_t index = 0;
  Box box;
};

/// The features that a leaf owns and that may be near another leaf.
struct LeafFeatures {
  std::vector<BoxedFeature> vertices;
  std::vector<BoxedFeature> edges;
  std::vector<BoxedFeature> faces;
  std::vector<BoxedFeature> folds;  ///< of quads that are not flat, by the quad's number

  /// Takes the features of `leaf` for which `keep(lower distance to `other`)` holds.
  template <typename Keep>
  void collect(const Surface& surface, const Region& leaf, const Box& other, const Keep& keep,
               DecisionCount& count) {
    const Mesh& mesh = surface.mesh();
    const RegionTree& tree = mesh.regions();
    vertices.clear();
    edges.clear();
    faces.clear();
    folds.clear();
    for (const std::uint32_t vertex : tree.vertices(leaf))
      add(vertices, vertex, surface, std::array{vertex}, other, keep);
    for (const std::uint32_t edge : tree.edges(leaf)) add(edges, edge, surface, mesh.edge(edge), other, keep);
    for (const std::uint32_t face : tree.faces(leaf)) {
      const auto corner = mesh.face(face);
      if (!add(faces, face, surface, corner, other, keep) || !is_folded(surface, face, count)) continue;
      add(folds, face, surface, std::array{corner[0], corner[2]}, other, keep);
    }
  }

 private:
  template <typename Corners, typename Keep>
  static bool add(std::vector<BoxedFeature>& features, std::uint32_t index, const Surface& surface,
                  const Corners& corners, const Box& other, const Keep& keep) {
    BoxedFeature feature{index, {}};
    for (const std::uint32_t corner : corners) feature.box.add(surface.position(corner));
    if (!keep(lower_distance(feature.box, other))) return false;
    features.push_back(feature);
    return true;
  }
};

struct LeafScratch {
  LeafFeatures a;
  LeafFeatures b;
};

/// Gives `sink` the name of the closest points of every vertex-face and edge-edge pair between two leaves, of
/// every edge that pierces a face, and of every fold's contacts with edges, folds and faces, leaving out
/// pairs of features whose boxes are certainly too far: `keep(lower distance)` says which are not, and may
/// come to say less meanwhile. A pair of features is met in one pair of leaves only, since each has one
/// owner; a name may be met several times.
template <typename Keep, typename Sink>
void for_each_name(const SurfacePair& pair, const Region& leaf_a, const Box& box_a, const Region& leaf_b,
                   const Box& box_b, LeafScratch& scratch, const Keep& keep, const Sink& sink) {
  scratch.a.collect(pair.a, leaf_a, box_b, keep, pair.count);
  scratch.b.collect(pair.b, leaf_b, box_a, keep, pair.count);
  const auto each = [&](const std::vector<BoxedFeature>& left, const std::vector<BoxedFeature>& right,
                        const auto& visit) {
    for (const BoxedFeature& l : left)
      for (const BoxedFeature& r : right)
        if (keep(lower_distance(l.box, r.box))) visit(l.index, r.index);
  };
  const auto each_overlap = [&](const std::vector<BoxedFeature>& left, const std::vector<BoxedFeature>& right,
                                const auto& visit) {
    for (const BoxedFeature& l : left)
      for (const BoxedFeature& r : right)
        if (lower_distance(l.box, r.box) == 0) visit(l.index, r.index);
  };
  const auto segments = [&](const FeaturePiece& a, const FeaturePiece& b) {
    const SegmentPairNames found = nearest_pieces_of_segments(pair.a, a, pair.b, b, pair.count);
    for (std::uint32_t i = 0; i < found.size; ++i)
      sink(ContactName::of(found.names[i][0], found.names[i][1]));
  };
  // A fold gives contacts only where the closest points are inside both segments: at its ends are the quad's
  // corners.
  const auto fold_segments = [&](const FeaturePiece& a, const FeaturePiece& b) {
    const SegmentPairNames found = nearest_pieces_of_segments(pair.a, a, pair.b, b, pair.count);
    if (found.size == 1 && found.names[0][0] == a && found.names[0][1] == b) sink(ContactName::of(a, b));
  };
  const auto pierced_b = [&](const FeaturePiece& segment, std::uint32_t face) {
    if (const auto piece = pierced_piece(pair.a, segment, pair.b, face, pair.count))
      sink(ContactName::of(segment, *piece, Meeting::pierced));
  };
  const auto pierced_a = [&](std::uint32_t face, const FeaturePiece& segment) {
    if (const auto piece = pierced_piece(pair.b, segment, pair.a, face, pair.count))
      sink(ContactName::of(*piece, segment, Meeting::pierced));
  };
  const auto fold = [](std::uint32_t face) { return face_piece(face, Piece::fold); };

  each(scratch.a.vertices, scratch.b.faces, [&](std::uint32_t vertex, std::uint32_t face) {
    sink(ContactName::of(vertex_piece(vertex),
                         nearest_piece_of_face(pair.a.position(vertex), pair.b, face, pair.count)));
  });
  each(scratch.a.faces, scratch.b.vertices, [&](std::uint32_t face, std::uint32_t vertex) {
    sink(ContactName::of(nearest_piece_of_face(pair.b.position(vertex), pair.a, face, pair.count),
                         vertex_piece(vertex)));
  });
  each(scratch.a.edges, scratch.b.edges,
       [&](std::uint32_t a, std::uint32_t b) { segments(edge_piece(a), edge_piece(b)); });
  each(scratch.a.edges, scratch.b.folds,
       [&](std::uint32_t a, std::uint32_t b) { fold_segments(edge_piece(a), fold(b)); });
  each(scratch.a.folds, scratch.b.edges,
       [&](std::uint32_t a, std::uint32_t b) { fold_segments(fold(a), edge_piece(b)); });
  each(scratch.a.folds, scratch.b.folds,
       [&](std::uint32_t a, std::uint32_t b) { fold_segments(fold(a), fold(b)); });
  each_overlap(scratch.a.edges, scratch.b.faces,
               [&](std::uint32_t edge, std::uint32_t face) { pierced_b(edge_piece(edge), face); });
  each_overlap(scratch.a.faces, scratch.b.edges,
               [&](std::uint32_t face, std::uint32_t edge) { pierced_a(face, edge_piece(edge)); });
  each_overlap(scratch.a.folds, scratch.b.faces,
               [&](std::uint32_t a, std::uint32_t b) { pierced_b(fold(a), b); });
  each_overlap(scratch.a.faces, scratch.b.folds,
               [&](std::uint32_t a, std::uint32_t b) { pierced_a(a, fold(b)); });
}

}  // namespace graze
