#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <graze/bytes_of.hpp>
#include <graze/error.hpp>
#include <graze/surface.hpp>
#include <limits>
#include <utility>

#include "limits.hpp"
#include "validate.hpp"

namespace graze {

namespace {

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> count{0};
  return count.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace

Surface::Surface(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)), serial_(next_serial()) {
  if (mesh_ == nullptr) throw Error("surface: there is no mesh");
  positions_.assign(mesh_->vertex_count(), Eigen::Vector3d::Zero());
  incoming_ = positions_;
  const auto rest = mesh_->rest();
  take(read(0, mesh_->vertex_count(), [&](std::uint32_t vertex) { return rest[vertex]; }));
}

bool Surface::is_within_limits(const Eigen::Vector3d& position) {
  return graze::is_within_limits(position);
}

namespace {

/// By bits: -0 is another answer than 0, though no motion.
bool is_same(const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
  return std::memcmp(left.data(), right.data(), 3 * sizeof(double)) == 0;  // NOLINT(bugprone-suspicious-*)
}

}  // namespace

void Surface::PartRead::add(const PartRead& later) {
  if (bad_vertex != ReadResult::no_vertex) return;
  bad_vertex = later.bad_vertex;
  bad_position = later.bad_position;
  furthest_squared = std::max(furthest_squared, later.furthest_squared);
  changed = changed || later.changed;
  if (!later.box.empty()) box.add(later.box);
}

template <typename PositionOf>
Surface::PartRead Surface::read(std::uint32_t begin, std::uint32_t end, const PositionOf& position_of) {
  PartRead part;
  Box box;  // these three stay in registers, which `part` does not
  double furthest_squared = 0;
  bool changed = false;
  for (std::uint32_t vertex = begin; vertex < end; ++vertex) {
    if (!mesh_->is_used(vertex)) continue;
    const Eigen::Vector3d position = position_of(vertex);
    if (!is_within_limits(position)) {
      part.bad_vertex = vertex;
      part.bad_position = position;
      return part;
    }
    furthest_squared = std::max(furthest_squared, (position - positions_[vertex]).squaredNorm());
    changed = changed || !is_same(position, positions_[vertex]);
    box.add(position);
    incoming_[vertex] = position;
  }
  part.furthest_squared = furthest_squared;
  part.changed = changed;
  part.box = box;
  return part;
}

Surface::ReadResult Surface::take(const PartRead& all) {
  ReadResult result;
  result.bad_vertex = all.bad_vertex;
  result.bad_position = all.bad_position;
  if (!result.taken()) return result;
  if (all.changed || version_ == 0) {
    result.displacement = std::sqrt(all.furthest_squared);
    positions_.swap(incoming_);
    count_motion(result.displacement * round_up + lost_to_underflow, std::exchange(box_, all.box));
  }
  displacement_ = result.displacement;
  return result;
}

/// A motion beyond the object's size is a jump: what was known before it is of no use, and the sum of all
/// motions would stay too coarse for the small ones that follow.
void Surface::count_motion(double displacement, const Box& before) {
  ++version_;
  const double size = before.empty() ? 0 : (before.max - before.min).maxCoeff();
  if (displacement > size)
    travel_ = {travel_.epoch + 1, 0};
  else
    travel_.distance = (travel_.distance + displacement) * round_up;
}

double Surface::motion_since(const Travel& then) const {
  if (then.epoch != travel_.epoch) return std::numeric_limits<double>::infinity();
  return (travel_.distance - then.distance) * round_up;
}

double Surface::motion_since(const Refit& refit) const {
  if (refit.version == version_) return 0;
  if (refit.version == 0) return std::numeric_limits<double>::infinity();
  return motion_since(refit.travel);
}

double Surface::motion_since_refit(RefitOf what) const {
  return motion_since(what == RefitOf::vertices ? vertex_refit_ : face_refit_);
}

double Surface::leaf_size() const {
  return std::ldexp((box_.max - box_.min).maxCoeff(), -static_cast<int>(mesh_->regions().leaf_level()));
}

Surface::ReadResult Surface::set_positions(const PositionView& view) {
  return take(read_positions(view, 0, mesh_->vertex_count()));
}

Surface::ReadResult Surface::set_pose(const std::array<double, 12>& rows) {
  return take(read_pose(rows, 0, mesh_->vertex_count()));
}

Surface::PartRead Surface::read_positions(const PositionView& view, std::uint32_t begin, std::uint32_t end) {
  return read(begin, end, [&](std::uint32_t vertex) { return view[vertex]; });
}

Surface::PartRead Surface::read_pose(const std::array<double, 12>& rows, std::uint32_t begin,
                                     std::uint32_t end) {
  const auto rest = mesh_->rest();
  return read(begin, end, [&](std::uint32_t vertex) {
    const Eigen::Vector3d& p = rest[vertex];
    const auto coordinate = [&](std::size_t row) {
      const double* const r = &rows[row * 4];
      return ((r[0] * p.x() + r[1] * p.y()) + r[2] * p.z()) + r[3];
    };
    return Eigen::Vector3d(coordinate(0), coordinate(1), coordinate(2));
  });
}

Box Surface::vertex_box_now(const Region& region) const {
  Box box;
  for (const std::uint32_t vertex : mesh_->regions().vertices(region)) box.add(positions_[vertex]);
  return box;
}

Box Surface::face_box_now(const Region& region) const {
  const RegionTree& tree = mesh_->regions();
  Box box = vertex_box_now(region);
  for (const std::uint32_t face : tree.faces(region))
    for (const std::uint32_t corner : mesh_->face(face)) box.add(positions_[corner]);
  for (const std::uint32_t edge : tree.edges(region)) box.add(positions_[mesh_->edge(edge)[1]]);
  return box;
}

void Surface::refit(RefitOf what) {
  if (motion_since_refit(what) == 0) return;
  begin_refit(what);
  refit_regions(what, 0, mesh_->regions().region_count());
  finish_refit(what);
}

void Surface::begin_refit(RefitOf what) {
  const std::uint32_t count = mesh_->regions().region_count();
  if (what == RefitOf::faces) return face_boxes_.resize(count);
  radii_.resize(count);
  vertex_boxes_.resize(count);
}

void Surface::refit_regions(RefitOf what, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t index = begin; index < end; ++index) {
    if (what == RefitOf::vertices)
      refit_vertices_of(index);
    else if (const Region& region = mesh_->regions().region(index); region.is_leaf())
      face_boxes_[index] = face_box_now(region);
  }
}

void Surface::refit_vertices_of(std::uint32_t index) {
  const Region& region = mesh_->regions().region(index);
  double radius_squared = 0;
  Box box;
  for (const std::uint32_t vertex : mesh_->regions().vertices(region)) {
    radius_squared = std::max(radius_squared, (positions_[vertex] - middle(region)).squaredNorm());
    box.add(positions_[vertex]);
  }
  radii_[index] = std::sqrt(radius_squared);
  vertex_boxes_[index] = box;
}

void Surface::finish_refit(RefitOf what) {
  what == RefitOf::vertices ? finish_vertex_refit() : finish_face_refit();
  validate(*this);
}

void Surface::finish_vertex_refit() {
  const RegionTree& tree = mesh_->regions();
  level_radii_.assign(tree.level_count(), 0);
  for (std::uint32_t index = 0; index < tree.region_count(); ++index) {
    double& radius = level_radii_[tree.region(index).level];
    radius = std::max(radius, radii_[index]);
  }
  vertex_refit_ = {version_, travel_};
}

void Surface::finish_face_refit() {
  const RegionTree& tree = mesh_->regions();
  // Children have higher numbers than their parent, so theirs are already those of now.
  for (std::uint32_t index = tree.region_count(); index-- > 0;) {
    const Region& region = tree.region(index);
    if (region.is_leaf()) continue;
    Box box;
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      box.add(face_boxes_[region.first_child + child]);
    face_boxes_[index] = box;
  }
  face_refit_ = {version_, travel_};
}

std::size_t Surface::byte_count() const {
  return sizeof(Surface) + bytes_of(positions_) + bytes_of(incoming_) + bytes_of(radii_) +
         bytes_of(level_radii_) + bytes_of(vertex_boxes_) + bytes_of(face_boxes_);
}

}  // namespace graze
