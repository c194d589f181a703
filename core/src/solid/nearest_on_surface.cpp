#include "solid/nearest_on_surface.hpp"

#include <algorithm>
#include <cmath>

#include "closest_features/closest_features.hpp"

namespace graze {
namespace {

/// A lower bound of the squared distance of a point and a box.
double lower_squared(const Eigen::Vector3d& point, const Box& box) {
  const Eigen::Vector3d beside = (box.min - point).cwiseMax(point - box.max).cwiseMax(0.0);
  return beside.squaredNorm() * round_down - 0x1p-1000;
}

}  // namespace

/// One frame for all of the other surface. Its errors are a millionth of the surface's size, which leaves few
/// faces more to look at.
NearestOnSurface::NearestOnSurface(const SurfacePair& pair, bool are_of_a, LeafScratch& scratch)
    : pair_(pair),
      are_of_a_(are_of_a),
      from_(are_of_a ? pair.a : pair.b),
      to_(are_of_a ? pair.b : pair.a),
      slack_(to_.motion_since_face_refit()),
      scratch_(scratch),
      leaves_(are_of_a ? scratch.all_b : scratch.all_a),
      batch_(are_of_a ? scratch.filter.vertex_a : scratch.filter.vertex_b) {
  scratch.begin();
  scratch.filter.frame = FilterFrame(to_.box(), to_.box());
  leaves_.begin(to_, scratch.filter.frame, false);
}

std::optional<VertexNearest> NearestOnSurface::find(std::uint32_t vertex) {
  begin(vertex);
  open_.push_back({lower_of(0), 0});
  while (!open_.empty()) {
    const Open next = open_.back();
    open_.pop_back();
    if (next.lower > limit_) continue;
    const Region& region = to_.mesh().regions().region(next.region);
    if (region.is_leaf())
      add_leaf(region);
    else
      open_children(region);
  }
  add_bounded();
  return has_any_ ? std::optional(nearest_) : std::nullopt;
}

void NearestOnSurface::begin(std::uint32_t vertex) {
  point_ = from_.position(vertex);
  limit_ = std::numeric_limits<double>::infinity();
  // With groups, what was nearest to another vertex may be no feature for this one.
  if (has_any_ && pair_.groups == nullptr) {
    const FeaturePiece last = are_of_a_ ? nearest_.key.b() : nearest_.key.a();
    shrink_limit(squared_range(point_, simplex_of(to_, last).point[0]).high);
  }
  has_any_ = false;
  nearest_.vertex = are_of_a_ ? VertexOfPair::of_a(vertex) : VertexOfPair::of_b(vertex);
  to_frame(from_, std::span(&vertex, 1), scratch_.filter.frame, corner_.data());
  constexpr std::array<std::uint32_t, 4> first{};
  std::array<kernels::Point, 4> listed;
  kernels::filter().lay_out_points(corner_.data(), first.data(), 1, row_.data(), kernels::lanes,
                                   listed.data());
}

double NearestOnSurface::lower_of(std::uint32_t region) const {
  const Box& box = to_.face_boxes()[region];
  return lower_squared(point_, slack_ == 0 ? box : grown(box, slack_));
}

/// Puts the nearest child last, since that is taken first.
void NearestOnSurface::open_children(const Region& region) {
  const std::size_t begin = open_.size();
  for (std::uint32_t i = 0; i < region.child_count; ++i) {
    const Open child{lower_of(region.first_child + i), region.first_child + i};
    std::size_t at = open_.size();
    open_.push_back(child);
    for (; at > begin && open_[at - 1].lower < child.lower; --at) open_[at] = open_[at - 1];
    open_[at] = child;
  }
}

void NearestOnSurface::add_leaf(const Region& leaf) {
  pair_.check_time();
  const TriangleBlock& triangles = leaves_.of(to_, leaf, scratch_.corners).triangles;
  const kernels::Block all = triangles.block();
  if (all.count == 0) return;
  const kernels::Block boxes{all.data + kernels::box_at<3> * all.stride, all.stride, all.count};
  constexpr std::uint32_t row = 0;
  const kernels::NearPairs near = scratch_.filter.lists.room_for(all.count);
  const float limit = scratch_.filter.frame.to_local_limit(std::sqrt(limit_) * round_up);
  const std::size_t count = kernels::filter().near_boxes(
      {{row_.data(), kernels::lanes, 1}, kernels::box_at<1>, &row, 1}, boxes, limit, near);
  pair_.count.discarded_in_float += all.count - count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t number = near.column[i];
    const kernels::Point* const corner = triangles.corners(number);
    if (batch_.add({FeatureRefKind::vertex, nearest_.vertex.index()}, {corner_[0]},
                   triangles.view().ref_of(number), {corner[0], corner[1], corner[2]}))
      add_bounded();
  }
  if (!has_any_) add_bounded();
}

/// Empties the batch. The upper bounds of all its faces come first, so that few are left to be compared.
void NearestOnSurface::add_bounded() {
  const FilterFrame& frame = scratch_.filter.frame;
  const kernels::NearLimits limits{frame.to_local_limit(std::sqrt(limit_) * round_up),
                                   std::numeric_limits<float>::infinity()};
  near_.clear();
  const auto take = [&](const FeatureRef&, const FeatureRef& face, const KnownInFloat& known) {
    if (!may(face.index)) return;
    const bool is_known = known.voronoi != kernels::unsure_voronoi && to_.mesh().face(face.index).size() == 3;
    const SquaredRange squared = is_known ? squared_range(known, frame) : SquaredRange{};
    if (is_known) shrink_limit(squared.high);
    near_.push_back({is_known ? squared.low : 0, face.index});
  };
  pair_.count.discarded_in_float += batch_.empty(
      [&](auto& pairs) { return kernels::filter().bound_points_and_triangles(pairs, limits); }, take);
  for (const NearFace& near : near_)
    if (near.lower <= limit_) offer(near.face);
}

void NearestOnSurface::offer(std::uint32_t face) {
  VertexNearest offered{{}, nearest_.vertex};
  offered.key = key_of(nearest_piece_of_face(point_, to_, face, pair_.count, offered.squared));
  if (has_any_)
    keep_nearer(pair_, nearest_, offered);
  else
    nearest_ = offered;
  has_any_ = true;
  shrink_limit(nearest_.squared.high);
}

bool NearestOnSurface::may(std::uint32_t face) const {
  const FeatureRef vertex{FeatureRefKind::vertex, nearest_.vertex.index()};
  const FeatureRef other{FeatureRefKind::face, face};
  return are_of_a_ ? pair_.may(vertex, other) : pair_.may(other, vertex);
}

FeaturePairKey NearestOnSurface::key_of(const FeaturePiece& piece) const {
  const FeaturePiece vertex = vertex_piece(nearest_.vertex.index());
  return are_of_a_ ? FeaturePairKey::of(vertex, piece) : FeaturePairKey::of(piece, vertex);
}

}  // namespace graze
