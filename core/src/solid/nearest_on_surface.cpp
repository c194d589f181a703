#include "solid/nearest_on_surface.hpp"

#include <algorithm>
#include <cmath>

#include "closest_features/closest_features.hpp"
#include "surface/region_visit.hpp"

namespace graze {
namespace {

/// A lower bound of the squared distance of two boxes, or of a point and a box.
double lower_squared(const Box& a, const Box& b) {
  const Eigen::Vector3d beside = (b.min - a.max).cwiseMax(a.min - b.max).cwiseMax(0.0);
  return beside.squaredNorm() * round_down - 0x1p-1000;
}
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

/// Lists the leaves that may be nearer to any of the vertices than what was nearest to the last one.
void NearestOnSurface::begin_some(std::span<const std::uint32_t> vertices) {
  is_listed_ = false;
  // With groups, what was nearest to another vertex may be no feature for this one.
  if (!has_any_ || pair_.groups != nullptr) return;
  Box box;
  double limit = 0;
  for (const std::uint32_t vertex : vertices) {
    const Eigen::Vector3d point = from_.position(vertex);
    box.add(point);
    limit = std::max(limit, upper_beside_last(point));
  }
  listed_.clear();
  is_listed_ = true;
  visit_leaves(
      to_, [&](const Box& region) { return is_listed_ && lower_squared(box, region) <= limit; },
      [&](const Region& leaf) {
        const double lower = lower_squared(box, box_of(to_.mesh().regions().number(leaf)));
        is_listed_ = is_listed_ && listed_.push_back({lower, &leaf});
      });
  std::sort(listed_.begin(), listed_.end(), [](const NearLeaf& left, const NearLeaf& right) {
    return left.lower != right.lower ? left.lower < right.lower : left.leaf < right.leaf;
  });
}

std::optional<VertexNearest> NearestOnSurface::find(std::uint32_t vertex) {
  begin(vertex);
  if (is_listed_)
    search_listed();
  else
    search_all();
  add_bounded();
  return has_any_ ? std::optional(nearest_) : std::nullopt;
}

void NearestOnSurface::search_listed() {
  for (const NearLeaf& each : listed_) {
    if (each.lower > limit_) return;
    if (lower_of(to_.mesh().regions().number(*each.leaf)) <= limit_ && is_near(*each.leaf))
      add_leaf(*each.leaf);
  }
}

void NearestOnSurface::search_all() {
  open_.push_back({lower_of(0), 0});
  while (!open_.empty()) {
    const Open next = open_.back();
    open_.pop_back();
    if (next.lower > limit_) continue;
    const Region& region = to_.mesh().regions().region(next.region);
    if (!region.is_leaf())
      open_children(region);
    else if (is_near(region))
      add_leaf(region);
  }
}

/// Whether a leaf may be as near as the nearest, by its slab.
bool NearestOnSurface::is_near(const Region& leaf) {
  const LeafSlab& slab = LeafScratch::slab_now(are_of_a_ ? scratch_.slabs_b : scratch_.slabs_a, to_, leaf);
  return !(lower_squared(slab, point_ - to_.middle(leaf)) > limit_);
}

void NearestOnSurface::begin(std::uint32_t vertex) {
  point_ = from_.position(vertex);
  limit_ = std::numeric_limits<double>::infinity();
  if (has_any_ && pair_.groups == nullptr) shrink_limit(upper_beside_last(point_));
  has_any_ = false;
  nearest_.vertex = are_of_a_ ? VertexOfPair::of_a(vertex) : VertexOfPair::of_b(vertex);
  to_frame(from_, std::span(&vertex, 1), scratch_.filter.frame, corner_.data());
  constexpr std::array<std::uint32_t, 4> first{};
  std::array<kernels::Point, 4> listed;
  kernels::filter().lay_out_points(corner_.data(), first.data(), 1, row_.data(), kernels::lanes,
                                   listed.data());
}

/// At least the squared distance of a point and of what was nearest to the last vertex.
double NearestOnSurface::upper_beside_last(const Eigen::Vector3d& point) const {
  const Simplex last = simplex_of(to_, are_of_a_ ? nearest_.key.b() : nearest_.key.a());
  double upper = squared_range(point, last.point[0]).high;
  for (std::uint32_t i = 1; i < last.size; ++i)
    upper = std::min(upper, squared_range(point, last.point[i]).high);
  return upper;
}

Box NearestOnSurface::box_of(std::size_t region) const {
  const Box& box = to_.face_boxes()[region];
  return slack_ == 0 ? box : grown(box, slack_);
}

double NearestOnSurface::lower_of(std::size_t region) const {
  return slack_ == 0 ? lower_squared(point_, to_.face_boxes()[region])
                     : lower_squared(point_, box_of(region));
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
