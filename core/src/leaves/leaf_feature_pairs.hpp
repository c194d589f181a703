#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "arithmetic/certain.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "closest_features/piercing.hpp"
#include "core/pair/near_list.hpp"
#include "leaves/leaf_scratch.hpp"

namespace graze {

/// Finds the feature pairs of two leaves, or of a list, and gives their keys to a sink. These are the closest
/// points of every vertex-face and edge-edge pair between the selected features, and every edge that pierces
/// a face. They are also every fold's contacts with edges, folds and faces. Pairs certainly too far for the
/// range are left out, but never a piercing. A key may come several times. Pairs go from boxes to float and
/// from there to double, several at once. So keys may come later than the features. All have come after
/// `finish`. Features that the pair's groups leave out are not tested against each other.
///
///     selected features of two leaves, laid out in float
///       | boxes            too far: no key
///       v
///     batches for the kernels, sixteen pairs at once, in float
///       | uncertain        too far: no key; certain: the key goes to the sink
///       v
///     batches in double, with certified bounds
///       | uncertain        too far: no key; certain: the key goes to the sink
///       v
///     exact arithmetic     decides each pair that is left
///
/// From the distance `range.limit()` on a pair is of no interest. It may shrink meanwhile. Below the distance
/// `range.keys_only_below()` only the keys of pairs are wanted. Edges are tested for piercing faces where
/// `range.may_pierce()`, if they are not further than `range.touching()`. The search calls
/// `range.found(a, b)` for each pair that is not further than these, at times twice. It calls
/// `range.left_out(limit)` when something further than that was discarded. It asks `range.keep(lower)` about
/// features that are too large for float, with a bound from double. It calls `range.may_touch(segment,
/// is_of_a)` for every segment that touches a face of the other surface, and perhaps for others. Keys from
/// one for which `range.is_superfluous(key)` holds on are of no interest. If `range.wants_touching()`,
/// neither is anything that is apart.
///
/// If `Range::nearest_only` is true, the keys of a vertex and a face come with the range of their distance.
/// If `Range::inner_edges_only` is true, two edges have a key only if both closest points are inside. If
/// `Range::may_settle` is true, pairs that `LeafScratch::coinciding` settles are left to it.
template <typename Range, typename Sink>
class LeafFeaturePairs {
 public:
  LeafFeaturePairs(const SurfacePair& pair, LeafScratch& scratch, Range& range, const Sink& sink)
      : pair_(pair),
        scratch_(scratch),
        lists_(scratch.filter.lists),
        batches_(scratch.filter),
        range_(range),
        sink_(sink) {}

  /// The features that the scratch has taken. Those of one leaf are met in both orders where this is no more
  /// work.
  void add_selected() {
    use_frame();
    use_leaves();
    const SelectedLeaf& a = scratch_.a;
    const SelectedLeaf& b = scratch_.b;
    if (const kernels::Block faces = boxes_of(b.triangles); faces.count > 0) {
      near_vertices(a.vertices, b.triangles, faces, batches_.vertex_a, handle_vertex_a());
      touching(a.edges, b.triangles, faces, batches_.through_b, handle_through_b());
      touching(a.folds, b.triangles, faces, batches_.through_b, handle_through_b());
    }
    if (const kernels::Block faces = boxes_of(a.triangles); faces.count > 0 && !scratch_.is_one_leaf) {
      near_vertices(b.vertices, a.triangles, faces, batches_.vertex_b, handle_vertex_b());
      touching(b.edges, a.triangles, faces, batches_.through_a, handle_through_a());
      touching(b.folds, a.triangles, faces, batches_.through_a, handle_through_a());
    }
    near_segments(a.edges, b.edges);
    near_segments(a.edges, b.folds);
    near_segments(a.folds, b.edges);
    near_segments(a.folds, b.folds);
  }

  /// Adds the edges and folds that the scratch has taken with the faces that they may pierce, and nothing
  /// else.
  void add_selected_piercings() {
    use_frame();
    const SelectedLeaf& a = scratch_.a;
    const SelectedLeaf& b = scratch_.b;
    if (const kernels::Block faces = boxes_of(b.triangles); faces.count > 0) {
      touching(a.edges, b.triangles, faces, batches_.through_b, handle_through_b());
      touching(a.folds, b.triangles, faces, batches_.through_b, handle_through_b());
    }
    if (const kernels::Block faces = boxes_of(a.triangles); faces.count > 0) {
      touching(b.edges, a.triangles, faces, batches_.through_a, handle_through_a());
      touching(b.folds, a.triangles, faces, batches_.through_a, handle_through_a());
    }
  }

  /// Features that an earlier search has listed.
  void add_listed(std::span<const FeaturePair> listed) {
    batches_.frame = scratch_.frame;
    scratch_.listed_a.begin(pair_.a, scratch_.frame);
    scratch_.listed_b.begin(pair_.b, scratch_.frame);
    for (const FeaturePair& pair : listed) add_listed(pair);
  }

  void finish() {
    finish_batches();
    scratch_.naming.finish<Range::inner_edges_only>(pair_, sink_);
  }

 private:
  /// Goes on in the frame of the features that the scratch has taken.
  void use_frame() {
    if (batches_.frame == scratch_.frame) return;
    finish_batches();
    batches_.frame = scratch_.frame;
    limit_ = -1;
  }
  /// Goes on with segments of one leaf, or of two. A batch has no mixture, since its pairs do not tell.
  void use_leaves() {
    if (batches_.is_of_one_leaf == scratch_.is_one_leaf) return;
    bound(batches_.segments, handle_segments());
    batches_.is_of_one_leaf = scratch_.is_one_leaf;
  }

  // ---- By a list

  /// A surface's mesh, and where its vertices are in the frame.
  struct ListedSide {
    const IndexedMesh& mesh;
    VerticesInFrame& points;
  };

  void add_listed(const FeaturePair& pair) {
    const ListedSide a{pair_.a.mesh(), scratch_.listed_a};
    const ListedSide b{pair_.b.mesh(), scratch_.listed_b};
    if (pair.b.kind == FeatureRefKind::face) {
      pair.a.kind == FeatureRefKind::vertex
          ? add_with_face(batches_.vertex_a, pair.a, a, pair.b, b, handle_vertex_a())
          : add_with_face(batches_.through_b, pair.a, a, pair.b, b, handle_through_b());
    } else if (pair.a.kind == FeatureRefKind::face) {
      pair.b.kind == FeatureRefKind::vertex
          ? add_with_face(batches_.vertex_b, pair.b, b, pair.a, a, handle_vertex_b())
          : add_with_face(batches_.through_a, pair.b, b, pair.a, a, handle_through_a());
    } else if (batches_.segments.add(pair.a, listed_corners_of<2>(pair.a, a), pair.b,
                                     listed_corners_of<2>(pair.b, b))) {
      bound(batches_.segments, handle_segments());
    }
  }
  /// With each of the face's triangles.
  template <std::size_t Corners, typename Handler>
  void add_with_face(FloatBatch<Corners, 3>& batch, const FeatureRef& ref, const ListedSide& of_ref,
                     const FeatureRef& face, const ListedSide& of_face, const Handler& handle) {
    const std::array<kernels::Point, Corners> corners = listed_corners_of<Corners>(ref, of_ref);
    const auto corner = of_face.mesh.face(face.index);
    const auto point = [&](std::size_t i) { return of_face.points[corner[i]]; };
    for (std::size_t last = 2; last < corner.size(); ++last)
      if (batch.add(ref, corners, face, {point(0), point(last - 1), point(last)})) bound(batch, handle);
  }
  template <std::size_t Corners>
  static std::array<kernels::Point, Corners> listed_corners_of(const FeatureRef& ref,
                                                               const ListedSide& side) {
    if constexpr (Corners == 1) {
      return {side.points[ref.index]};
    } else {
      if (ref.kind == FeatureRefKind::edge) {
        const auto [first, second] = side.mesh.edge(ref.index);
        return {side.points[first], side.points[second]};
      }
      const auto corner = side.mesh.face(ref.index);
      return {side.points[corner[0]], side.points[corner[2]]};
    }
  }

  // ---- By boxes

  template <std::size_t Corners>
  kernels::Block boxes_of(const SelectedFeatures<Corners>& taken) {
    return lists_.gather(taken, kernels::box_at<Corners>, kernels::box_components);
  }

  /// Calls `use(rows, columns, count)` with pairs of the first `row_count` of `rows` and of `columns`, by
  /// number. These are the pairs whose boxes are not certainly further than a limit from each other. Returns
  /// whether that was not all.
  ///
  /// Pairs for which `settle(row, column)` holds are left out.
  template <std::size_t RowCorners, std::size_t Corners, typename Settle, typename Use>
  bool near_boxes(const SelectedFeatures<RowCorners>& rows, std::size_t row_count,
                  const SelectedFeatures<Corners>& columns, const kernels::Block& boxes, float limit,
                  const Settle& settle, const Use& use) {
    if (row_count == 0 || boxes.count == 0) return false;
    const kernels::NearPairs near = lists_.room_for(boxes.count);
    const std::size_t each = std::max<std::size_t>(1, FloatFilterScratch::pairs_at_once / boxes.count);
    std::size_t discarded = 0;
    for (std::size_t begin = 0; begin < row_count; begin += each) {
      const std::size_t count = std::min(each, row_count - begin);
      const std::uint32_t* const row_index = rows.index() + begin;
      const std::uint32_t* const column_index = columns.index();
      const std::size_t found = kernels::filter().near_boxes(
          {rows.all().block(), kernels::box_at<RowCorners>, row_index, count}, boxes, limit, near);
      discarded += count * boxes.count - found;
      for (std::size_t k = 0; k < found; ++k) near.row[k] = row_index[near.row[k]];
      for (std::size_t k = 0; k < found; ++k) near.column[k] = column_index[near.column[k]];
      use(near.row, near.column, leave_out_settled(near, found, settle));
    }
    pair_.count.discarded_in_float += discarded;
    return discarded > 0;
  }
  /// Keeps those pairs that are not settled, in their order. Returns how many they are.
  template <typename Settle>
  std::size_t leave_out_settled(const kernels::NearPairs& near, std::size_t count, const Settle& settle) {
    if constexpr (!Range::may_settle) return count;
    if (!scratch_.coinciding.any()) return count;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t row = near.row[k];
      const std::uint32_t column = near.column[k];
      near.row[kept] = row;
      near.column[kept] = column;
      kept += settle(row, column) ? 0U : 1U;
    }
    return kept;
  }
  /// Visits the pairs whose boxes are not certainly further than the range's limit.
  template <std::size_t RowCorners, std::size_t Corners, typename Settle, typename Use>
  void near_boxes(const SelectedFeatures<RowCorners>& rows, const SelectedFeatures<Corners>& columns,
                  const kernels::Block& boxes, const Settle& settle, const Use& use) {
    const double limit = range_.limit();
    if (near_boxes(rows, rows.count(), columns, boxes, local(limit), settle, use)) range_.left_out(limit);
  }

  template <typename Handler>
  void near_vertices(const SelectedFeatures<1>& vertices, const SelectedFeatures<3>& triangles,
                     const kernels::Block& boxes, FloatBatch<1, 3>& batch, const Handler& handle) {
    const bool are_of_a = &batch == &batches_.vertex_a;
    const auto settle = [&](std::uint32_t vertex, std::uint32_t triangle) {
      return are_of_a ? scratch_.coinciding.settle_vertex_and_face(pair_, vertex, triangle, sink_)
                      : scratch_.coinciding.settle_face_and_vertex(pair_, triangle, vertex, sink_);
    };
    near_boxes(vertices, triangles, boxes, settle,
               [&](const auto* of_vertices, const auto* of_faces, auto count) {
                 batch.add(vertices.all().view(), of_vertices, triangles.all().view(), of_faces, count,
                           [&] { bound(batch, handle); });
               });
  }

  template <typename Handler>
  void touching(const SelectedFeatures<2>& segments, const SelectedFeatures<3>& triangles,
                const kernels::Block& boxes, FloatBatch<2, 3>& batch, const Handler& handle) {
    if (!range_.may_pierce()) return;
    const kernels::Block touching_boxes{boxes.data, boxes.stride, triangles.touching()};
    const bool is_through_b = &batch == &batches_.through_b;
    const bool are_edges = segments.all().view().kind == FeatureRefKind::edge;
    const auto settle = [&](std::uint32_t segment, std::uint32_t triangle) {
      // An edge that ends at a corner does not pierce, but it touches.
      if (!are_edges || range_.collects_touching()) return false;
      return is_through_b ? scratch_.coinciding.ends_at_face_of_b(segment, triangle)
                          : scratch_.coinciding.ends_at_face_of_a(segment, triangle);
    };
    near_boxes(segments, segments.touching(), triangles, touching_boxes,
               batches_.frame.to_local_limit(range_.touching()), settle,
               [&](const auto* of_segments, const auto* of_faces, auto count) {
                 batch.add(segments.all().view(), of_segments, triangles.all().view(), of_faces, count,
                           [&] { bound(batch, handle); });
               });
  }

  void near_segments(const SelectedFeatures<2>& a, const SelectedFeatures<2>& b) {
    if (a.count() == 0 || b.count() == 0) return;
    const auto add = [&](const std::uint32_t* of_a, const std::uint32_t* of_b, std::size_t count) {
      batches_.segments.add(a.all().view(), of_a, b.all().view(), of_b, count,
                            [&] { bound(batches_.segments, handle_segments()); });
    };
    const bool are_edges =
        a.all().view().kind == FeatureRefKind::edge && b.all().view().kind == FeatureRefKind::edge;
    const auto settle = [&](std::uint32_t of_a, std::uint32_t of_b) {
      return are_edges && scratch_.coinciding.settle_edges(pair_, of_a, of_b, sink_);
    };
    if (a.count() <= b.count())
      near_boxes(a, b, boxes_of(b), settle, add);
    else
      near_boxes(
          b, a, boxes_of(a), [&](std::uint32_t of_b, std::uint32_t of_a) { return settle(of_a, of_b); },
          [&](const auto* of_b, const auto* of_a, auto count) { add(of_a, of_b, count); });
  }

  // ---- By the bounds of float

  void finish_batches() {
    bound(batches_.vertex_a, handle_vertex_a());
    bound(batches_.vertex_b, handle_vertex_b());
    bound(batches_.segments, handle_segments());
    bound(batches_.through_b, handle_through_b());
    bound(batches_.through_a, handle_through_a());
  }

  template <typename Handler>
  void bound(FloatBatch<1, 3>& batch, const Handler& handle) {
    bound_near(batch, kernels::filter().bound_points_and_triangles, handle);
  }
  template <typename Handler>
  void bound(FloatBatch<2, 2>& batch, const Handler& handle) {
    bound_near(batch, kernels::filter().bound_segments, handle);
  }
  template <typename Handler>
  void bound(FloatBatch<2, 3>& batch, const Handler& handle) {
    pair_.check_time();
    if (range_.is_listing()) list_near_planes(batch);
    pair_.count.discarded_in_float += batch.empty(kernels::filter().passing, handle);
  }
  /// Lists the segments that pass by their triangles now, but near: they may come to pierce them.
  void list_near_planes(FloatBatch<2, 3>& batch) {
    const float touching = batches_.frame.to_local_limit(range_.touching());
    const bool is_through_a = &batch == &batches_.through_a;
    batch.ask([&](auto& pairs) { return kernels::filter().bound_over_planes(pairs, touching); },
              [&](const FeatureRef& segment, const FeatureRef& face) {
                const FeatureRef& a = is_through_a ? face : segment;
                const FeatureRef& b = is_through_a ? segment : face;
                if (pair_.may_pierce(a, b)) range_.found(a, b);
              });
  }
  template <typename Batch, typename Kernel, typename Handler>
  void bound_near(Batch& batch, Kernel kernel, const Handler& handle) {
    pair_.check_time();
    const double limit = range_.limit();
    const kernels::NearLimits limits{local(limit), local_below()};
    const std::size_t discarded = batch.empty([&](auto& pairs) { return kernel(pairs, limits); }, handle);
    pair_.count.discarded_in_float += discarded;
    if (discarded > 0) range_.left_out(limit);
  }

  auto handle_vertex_a() {
    return [this](const FeatureRef& vertex, const FeatureRef& face, const KnownInFloat& known) {
      if (!pair_.may(vertex, face)) return;
      range_.found(vertex, face);
      if (known.voronoi != kernels::unsure_voronoi && is_triangle(pair_.b, face))
        return accept_in_float(vertex_piece(vertex.index), piece_in(pair_.b, face, known), range_of(known));
      if (range_.is_superfluous(lowest_key(vertex.index, lowest_corner(pair_.b, face)))) return;
      if (may_be_near(pair_.a, vertex, pair_.b, face, known))
        scratch_.naming.add_vertex_and_face(pair_, vertex.index, face.index, sink_);
    };
  }
  auto handle_vertex_b() {
    return [this](const FeatureRef& vertex, const FeatureRef& face, const KnownInFloat& known) {
      if (!pair_.may(face, vertex)) return;
      range_.found(face, vertex);
      if (known.voronoi != kernels::unsure_voronoi && is_triangle(pair_.a, face))
        return accept_in_float(piece_in(pair_.a, face, known), vertex_piece(vertex.index), range_of(known));
      if (range_.is_superfluous(lowest_key(lowest_corner(pair_.a, face), vertex.index))) return;
      if (may_be_near(pair_.b, vertex, pair_.a, face, known))
        scratch_.naming.add_face_and_vertex(pair_, face.index, vertex.index, sink_);
    };
  }
  auto handle_segments() {
    return [this](const FeatureRef& a, const FeatureRef& b, const KnownInFloat& known) {
      if (batches_.is_of_one_leaf && b.index < a.index && a.kind == b.kind) return;
      if (!pair_.may(a, b)) return;
      range_.found(a, b);
      const bool are_edges = a.kind == FeatureRefKind::edge && b.kind == FeatureRefKind::edge;
      if (known.voronoi != kernels::unsure_voronoi && are_edges) {
        const auto voronoi = static_cast<std::size_t>(known.voronoi);
        if (Range::inner_edges_only && voronoi != inside_both) return;
        return accept_in_float(piece_of_edge(pair_.a.mesh(), a.index, voronoi >> 2U),
                               piece_of_edge(pair_.b.mesh(), b.index, voronoi & 3U), SquaredRange{0, 0});
      }
      if (are_edges &&
          range_.is_superfluous(lowest_key(pair_.a.mesh().edge(a.index)[0], pair_.b.mesh().edge(b.index)[0])))
        return;
      if (!may_be_near(pair_.a, a, pair_.b, b, known)) return;
      if (range_.wants_touching() && certainly_apart(ends_of(pair_.a, a), ends_of(pair_.b, b))) return;
      if (are_edges)
        scratch_.naming.add_edges<Range::inner_edges_only>(pair_, a.index, b.index, sink_);
      else if (is_segment(pair_.a, a) && is_segment(pair_.b, b))
        offer_inner(piece_of(a), piece_of(b));
    };
  }
  auto handle_through_b() {
    return [this](const FeatureRef& segment, const FeatureRef& face, const KnownInFloat& known) {
      if (!pair_.may_pierce(segment, face) || !may_touch(pair_.a, segment, pair_.b, face, known)) return;
      range_.may_touch(segment, true);
      pair_.check_time();
      const FeaturePiece a = piece_of(segment);
      const FeaturePiece lowest_of_face = face_piece(face.index, Piece::fold);
      if (range_.is_superfluous(in_order(pair_, FeaturePairKey::of(a, lowest_of_face, Meeting::pierced))))
        return;
      if (!is_segment(pair_.a, segment)) return;
      if (const auto b = pierced(pair_.a, a, pair_.b, face, known))
        sink_(FeaturePairKey::of(a, *b, Meeting::pierced), SquaredRange{});
    };
  }
  auto handle_through_a() {
    return [this](const FeatureRef& segment, const FeatureRef& face, const KnownInFloat& known) {
      if (!pair_.may_pierce(face, segment) || !may_touch(pair_.b, segment, pair_.a, face, known)) return;
      range_.may_touch(segment, false);
      pair_.check_time();
      const FeaturePiece b = piece_of(segment);
      const FeaturePiece lowest_of_face = face_piece(face.index, Piece::fold);
      if (range_.is_superfluous(in_order(pair_, FeaturePairKey::of(lowest_of_face, b, Meeting::pierced))))
        return;
      if (!is_segment(pair_.b, segment)) return;
      if (const auto a = pierced(pair_.b, b, pair_.a, face, known))
        sink_(FeaturePairKey::of(*a, b, Meeting::pierced), SquaredRange{});
    };
  }
  std::optional<FeaturePiece> pierced(const Surface& surface, const FeaturePiece& segment,
                                      const Surface& other, const FeatureRef& face,
                                      const KnownInFloat& known) {
    if (known.voronoi != kernels::passes_through || !is_triangle(other, face))
      return pierced_piece(surface, segment, other, face.index, pair_.count);
    ++pair_.count.named_in_float;
    return face_piece(face.index, Piece::first);
  }

  /// The lowest key that two features can have, by the lowest vertex of each.
  [[nodiscard]] FeaturePairKey lowest_key(std::uint32_t vertex_a, std::uint32_t vertex_b) const {
    return in_order(pair_, FeaturePairKey::of(vertex_piece(vertex_a), vertex_piece(vertex_b)));
  }
  static std::uint32_t lowest_corner(const Surface& surface, const FeatureRef& face) {
    const auto corner = surface.mesh().face(face.index);
    return *std::min_element(corner.begin(), corner.end());
  }

  // ---- By the places of float

  static bool is_triangle(const Surface& surface, const FeatureRef& face) {
    return surface.mesh().face(face.index).size() == 3;
  }
  static FeaturePiece piece_in(const Surface& surface, const FeatureRef& face, const KnownInFloat& known) {
    return piece_of_triangle(surface.mesh(), face.index, static_cast<std::size_t>(known.voronoi));
  }
  /// The number of `KnownInFloat::voronoi` of two segments whose closest points are inside both.
  static constexpr std::size_t inside_both = 5 * static_cast<std::size_t>(Along::inside);

  /// Accepts a pair that is certainly nearer than the distance asked for.
  void accept_in_float(const FeaturePiece& a, const FeaturePiece& b, const SquaredRange& squared) {
    ++pair_.count.named_in_float;
    sink_(FeaturePairKey::of(a, b), squared);
  }
  /// The distance of a vertex and a triangle that float is certain of. Only for the nearest it matters how
  /// near they are.
  [[nodiscard]] SquaredRange range_of(const KnownInFloat& known) const {
    if constexpr (!Range::nearest_only) return {0, 0};
    return squared_range(known, batches_.frame);
  }

  /// Whether a pair that float has left may be near. Features that are too large for float have not been
  /// tested.
  bool may_be_near(const Surface& a, const FeatureRef& of_a, const Surface& b, const FeatureRef& of_b,
                   const KnownInFloat& known) {
    return known.is_bounded || range_.keep(lower_in_double(a, of_a, b, of_b));
  }
  static bool may_touch(const Surface& a, const FeatureRef& of_a, const Surface& b, const FeatureRef& of_b,
                        const KnownInFloat& known) {
    return known.is_bounded || lower_in_double(a, of_a, b, of_b) == 0;
  }
  static double lower_in_double(const Surface& a, const FeatureRef& of_a, const Surface& b,
                                const FeatureRef& of_b) {
    return lower_distance(box_of(a, of_a.kind, of_a.index), box_of(b, of_b.kind, of_b.index));
  }
  /// A limit in the frame. It mostly is the one of the last call.
  float local(double limit) {
    if (limit != limit_) {
      limit_ = limit;
      local_limit_ = batches_.frame.to_local_limit(limit);
    }
    return local_limit_;
  }
  /// A distance in the frame below which a pair is certainly nearer than `keys_only_below`.
  [[nodiscard]] float local_below() const { return batches_.frame.to_local_below(range_.keys_only_below()); }

  // ---- Exactly

  /// A diagonal of a quad is one only where it is a fold.
  bool is_segment(const Surface& surface, const FeatureRef& of) {
    return of.kind == FeatureRefKind::edge || scratch_.folds.is_fold(surface, of.index, pair_.count);
  }
  static FeaturePiece piece_of(const FeatureRef& segment) {
    return segment.kind == FeatureRefKind::edge ? edge_piece(segment.index)
                                                : face_piece(segment.index, Piece::fold);
  }
  static std::array<Eigen::Vector3d, 2> ends_of(const Surface& surface, const FeatureRef& segment) {
    const auto [first, second, unused] = corners_of(surface.mesh(), piece_of(segment));
    return {surface.position(first), surface.position(second)};
  }
  /// A fold gives contacts only where the closest points are inside both segments: at its ends are the quad's
  /// corners.
  void offer_inner(const FeaturePiece& a, const FeaturePiece& b) {
    SquaredRange squared;
    const ClosestPiecesOfSegments found =
        nearest_pieces_of_segments(pair_.a, a, pair_.b, b, pair_.count, squared);
    if (found.size == 1 && found.pieces[0][0] == a && found.pieces[0][1] == b)
      sink_(FeaturePairKey::of(a, b), squared);
  }

  const SurfacePair& pair_;
  LeafScratch& scratch_;
  FloatFilterScratch& lists_;
  FloatBatches& batches_;
  Range& range_;
  const Sink& sink_;
  double limit_ = -1;  ///< none yet
  float local_limit_ = 0;
};

}  // namespace graze
