#include "core/surface/surface.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <graze/error.hpp>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/limits.hpp"
#include "core/base/bytes_of.hpp"
#include "kernels/point_registers.hpp"
#include "surface/passes_for.hpp"
#include "surface/validate_surface.hpp"

namespace graze {

namespace {

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> count{0};
  return count.fetch_add(1, std::memory_order_relaxed) + 1;
}

/// Empties a list and frees its memory. Assigning an empty one in braces would keep that.
template <typename Element>
void let_go(std::vector<Element>& elements) noexcept {
  std::vector<Element>().swap(elements);
}

}  // namespace

namespace {

std::shared_ptr<const IndexedMesh> shared_data(std::shared_ptr<const Mesh> mesh) {
  if (mesh == nullptr) return nullptr;
  const IndexedMesh* const data = &indexed(*mesh);
  return {std::move(mesh), data};
}

}  // namespace

Surface::Surface(std::shared_ptr<const Mesh> mesh) : Surface(shared_data(std::move(mesh))) {}

Surface::Surface(std::shared_ptr<const IndexedMesh> mesh) : mesh_(std::move(mesh)), serial_(next_serial()) {
  if (mesh_ == nullptr) throw Error("surface: there is no mesh");
  viewed_ = mesh_->rest();
  pose_ = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  box_ = survey(*mesh_, viewed_, 0, mesh_->vertex_count()).box;
  version_ = 1;
}

void Surface::succeed(const Surface& before) {
  version_ = before.version_ + 1;
  travel_ = {before.travel_.epoch + 1, 0};
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

void Surface::PartSeen::add(const PartSeen& later) {
  if (bad_vertex != ReadResult::no_vertex) return;
  bad_vertex = later.bad_vertex;
  bad_position = later.bad_position;
  furthest_squared = std::max(furthest_squared, later.furthest_squared);
  furthest = furthest.cwiseMax(later.furthest);
  changed = changed || later.changed;
  in_double = later.in_double;
  if (!later.box.empty()) box.add(later.box);
}

template <typename PositionOf>
Surface::PartSeen Surface::scan(std::uint32_t begin, std::uint32_t end, const PositionOf& position_of) const {
  PartSeen part;
  Box box;  // these three stay in registers, which `part` does not
  double furthest_squared = 0;
  bool changed = false;
  for (std::uint32_t vertex = begin; vertex < end; ++vertex) {
    if (!mesh_->is_used(vertex)) continue;
    const Eigen::Vector3d now = position_of(vertex);
    if (!is_within_limits(now)) {
      part.bad_vertex = vertex;
      part.bad_position = now;
      return part;
    }
    const Eigen::Vector3d before = position(vertex);
    furthest_squared = std::max(furthest_squared, (now - before).squaredNorm());
    changed = changed || !is_same(now, before);
    box.add(now);
  }
  part.furthest_squared = furthest_squared;
  part.changed = changed;
  part.box = box;
  return part;
}

template <typename PositionOf>
void Surface::write(std::uint32_t begin, std::uint32_t end, const PositionOf& position_of) {
  for (std::uint32_t vertex = begin; vertex < end; ++vertex) {
    if (!mesh_->is_used(vertex)) continue;
    if (in_double_.empty())
      in_float_[vertex] = position_of(vertex).template cast<float>();
    else
      in_double_[vertex] = position_of(vertex);
  }
}

Surface::ReadResult Surface::result_of(const PartSeen& all) const {
  ReadResult result;
  result.bad_vertex = all.bad_vertex;
  result.bad_position = all.bad_position;
  if (!result.taken()) return result;
  result.changed = all.changed || is_behind_;
  if (result.changed)
    result.displacement = is_behind_ ? std::numeric_limits<double>::infinity()
                                     : std::sqrt(std::max(all.furthest_squared, all.furthest.squaredNorm()));
  return result;
}

/// Counts a read of good positions.
void Surface::count_read(const ReadResult& result, const Box& now) {
  is_behind_ = false;
  displacement_ = result.displacement;
  if (result.changed) pose_.reset();
  if (result.changed)
    count_motion(result.displacement * round_up + lost_to_underflow, std::exchange(box_, now));
}

Surface::ReadResult Surface::accept(const PartSeen& all) {
  ReadResult result = result_of(all);
  if (result.changed) own_positions(all.in_double);
  if (result.taken()) count_read(result, all.box);
  return result;
}

Surface::ReadResult Surface::take_in_place(const PartSeen& all, const PositionView& view) {
  ReadResult result = result_of(all);
  if (result.changed) {
    let_go(in_float_);
    let_go(in_double_);
    viewed_ = view;
  }
  if (result.taken()) count_read(result, all.box);
  return result;
}

/// Has memory for all positions in a precision. Where there is none, nothing has changed.
void Surface::own_positions(bool in_double) {
  const std::size_t count = mesh_->vertex_count();
  if ((in_double ? in_double_.size() : in_float_.size()) != count) {
    in_double ? in_double_.assign(count, Eigen::Vector3d::Zero())
              : in_float_.assign(count, Eigen::Vector3f::Zero());
    in_double ? let_go(in_float_) : let_go(in_double_);
  }
  viewed_ = {};
}

void Surface::reserve_positions(bool in_double) {
  in_double ? in_double_.reserve(mesh_->vertex_count()) : in_float_.reserve(mesh_->vertex_count());
}

void Surface::end_view() {
  viewed_ = has_own_positions() ? PositionView() : PositionView(mesh_->rest());
}

void Surface::view(const PositionView& view, const Box& box) {
  viewed_ = view;
  pose_.reset();
  is_behind_ = true;
  displacement_ = std::numeric_limits<double>::infinity();
  count_motion(displacement_, std::exchange(box_, box));
}

/// A motion beyond the object's size is a jump. Everything known before it is of no use, and the sum of all
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
  return motion_since(refits_[static_cast<std::size_t>(what)]);
}

double Surface::leaf_size() const {
  return std::ldexp((box_.max - box_.min).maxCoeff(), -static_cast<int>(mesh_->regions().leaf_level()));
}

Surface::ReadResult Surface::set_positions(const PositionView& view) {
  ReadResult result = accept(scan_positions(view, 0, mesh_->vertex_count()));
  if (result.changed) write_positions(view, 0, mesh_->vertex_count());
  return result;
}

void Surface::copy_refitted(const Surface& from) {
  const bool is_at_rest = from.positions().data() == positions().data();
  if (!is_at_rest) (void)set_positions(from.positions());
  refit_faces();
}

namespace {

/// Whether positions follow one another in memory, all of them used.
bool is_packed(const IndexedMesh& mesh, const PositionView& view) {
  const std::size_t number = view.is_double() ? sizeof(double) : sizeof(float);
  return mesh.uses_all_vertices() && view.stride_bytes() == 3 * number && view.has_joined_coordinates() &&
         reinterpret_cast<std::uintptr_t>(view.data()) % number == 0;
}

template <typename Number>
Box box_of(const kernels::PositionsSeen<Number>& seen) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = static_cast<double>(seen.min[axis]);
    box.max[axis] = static_cast<double>(seen.max[axis]);
  }
  return box;
}

/// Surveys packed positions by fast passes. Returns nothing where one of them is bad.
template <typename Number>
std::optional<Surface::PartSeen> seen_in_survey(const void* now, std::uint32_t begin, std::uint32_t end) {
  kernels::PositionsSeen<Number> seen{};
  passes_for<Number>().survey(static_cast<const Number*>(now) + std::size_t{3} * begin, end - begin,
                              static_cast<Number>(largest_coordinate), seen);
  if (seen.bad) return std::nullopt;
  Surface::PartSeen part;
  part.box = box_of(seen);
  return part;
}

std::optional<Surface::PartSeen> seen_in_survey(const PositionView& view, std::uint32_t begin,
                                                std::uint32_t end) {
  return view.is_double() ? seen_in_survey<double>(view.data(), begin, end)
                          : seen_in_survey<float>(view.data(), begin, end);
}

/// Whether a surface has these positions already, in whatever precision. Of others mostly the first one says
/// so.
bool has_positions(const Surface& surface, const PositionView& view, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t vertex = begin; vertex < end; ++vertex)
    if (!is_same(view[vertex], surface.position(vertex))) return false;
  return true;
}

/// Surveys packed positions that come in another precision than before, or first of all. Unless they are
/// those that the surface has, they count as moved by any distance.
std::optional<Surface::PartSeen> seen_as_jump(const Surface& surface, const PositionView& view,
                                              std::uint32_t begin, std::uint32_t end) {
  auto part = seen_in_survey(view, begin, end);
  if (!part || has_positions(surface, view, begin, end)) return part;
  part->changed = true;
  part->furthest_squared = std::numeric_limits<double>::infinity();
  return part;
}

/// Surveys any positions, one by one.
Surface::PartSeen seen_one_by_one(const IndexedMesh& mesh, const PositionView& view, std::uint32_t begin,
                                  std::uint32_t end) {
  Surface::PartSeen part;
  for (std::uint32_t vertex = begin; vertex < end; ++vertex) {
    if (!mesh.is_used(vertex)) continue;
    const Eigen::Vector3d now = view[vertex];
    if (!is_within_limits(now)) {
      part.bad_vertex = vertex;
      part.bad_position = now;
      return part;
    }
    part.box.add(now);
  }
  return part;
}

/// Compares positions by fast passes with those before, which lie in the same way. Returns nothing where one
/// of them is bad.
template <typename Number>
std::optional<Surface::PartSeen> seen_in_passes(const void* now, const void* before, std::uint32_t begin,
                                                std::uint32_t end, Surface::Displacement displacement) {
  kernels::PositionsSeen<Number> seen{};
  const Number* const first = static_cast<const Number*>(now) + std::size_t{3} * begin;
  const Number* const was_first = static_cast<const Number*>(before) + std::size_t{3} * begin;
  const kernels::PassesOf<Number>& passes = passes_for<Number>();
  passes.compare(first, was_first, end - begin, static_cast<Number>(largest_coordinate), seen);
  if (seen.bad) return std::nullopt;
  Surface::PartSeen part;
  part.changed = seen.changed;
  part.box = box_of(seen);
  // A difference is rounded once. Where it underflows it is exact.
  if (displacement == Surface::Displacement::bound)
    for (int axis = 0; axis < 3; ++axis)
      part.furthest[axis] = static_cast<double>(seen.furthest[axis]) *
                            (1 + static_cast<double>(std::numeric_limits<Number>::epsilon()));
  if (displacement == Surface::Displacement::bound || !part.changed) return part;
  part.furthest_squared = passes.furthest(first, was_first, end - begin);
  return part;
}

}  // namespace

Eigen::Vector3d Surface::posed(const std::array<double, 12>& rows, const Eigen::Vector3d& p) {
  const auto coordinate = [&](std::size_t row) {
    const double* const r = &rows[row * 4];
    return ((r[0] * p.x() + r[1] * p.y()) + r[2] * p.z()) + r[3];
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

/// Whether positions lie in memory as the surface's own do.
bool Surface::is_laid_out_like(const PositionView& view) const {
  return is_packed(*mesh_, view) && view.is_double() == positions().is_double();
}

bool Surface::can_view(const PositionView& view) const {
  return is_packed(*mesh_, view);
}

Surface::PartSeen Surface::scan_positions(const PositionView& view, std::uint32_t begin, std::uint32_t end,
                                          Displacement displacement) const {
  std::optional<PartSeen> part;
  const void* const before = positions().data();
  if (begin < end && is_laid_out_like(view))
    part = view.is_double() ? seen_in_passes<double>(view.data(), before, begin, end, displacement)
                            : seen_in_passes<float>(view.data(), before, begin, end, displacement);
  else if (begin < end && displacement == Displacement::bound && is_packed(*mesh_, view))
    part = seen_as_jump(*this, view, begin, end);
  if (!part) part = scan(begin, end, [&](std::uint32_t vertex) { return view[vertex]; });
  part->in_double = view.is_double();
  return *part;
}

Surface::PartSeen Surface::survey(const IndexedMesh& mesh, const PositionView& view, std::uint32_t begin,
                                  std::uint32_t end) {
  std::optional<PartSeen> part;
  if (begin < end && is_packed(mesh, view)) part = seen_in_survey(view, begin, end);
  if (!part) part = seen_one_by_one(mesh, view, begin, end);
  return *part;
}

Surface::PartSeen Surface::scan_pose(const std::array<double, 12>& rows, std::uint32_t begin,
                                     std::uint32_t end) const {
  return scan(begin, end, [&](std::uint32_t vertex) { return posed(rows, mesh_->rest()[vertex]); });
}

namespace {

/// Computes `posed` of each point, x and y at once.
void pose_vertices(const std::array<double, 12>& rows, std::span<const Eigen::Vector3d> rest,
                   Eigen::Vector3d* now) {
  GRAZE_VECTOR(Two, double, 2);
  const auto column = [&](std::size_t number) { return Two{rows[number], rows[4 + number]}; };
  const Two first = column(0), second = column(1), third = column(2), by = column(3);
  // In variables of their own, since what is written could be the rows for all that the compiler knows.
  const double last[] = {rows[8], rows[9], rows[10], rows[11]};
  double* to = now->data();
  for (const Eigen::Vector3d& p : rest) {
    const Two xy = ((first * p.x() + second * p.y()) + third * p.z()) + by;
    const double z = ((last[0] * p.x() + last[1] * p.y()) + last[2] * p.z()) + last[3];
    std::memcpy(to, &xy, sizeof xy);
    to[2] = z;
    to += 3;
  }
}

bool is_same_pose(const std::array<double, 12>& left, const std::array<double, 12>& right) {
  return std::memcmp(left.data(), right.data(), sizeof left) == 0;  // NOLINT(bugprone-suspicious-*): bits
}

}  // namespace

Surface::ReadResult Surface::set_pose(const std::array<double, 12>& rows) {
  const Box box = mesh_->rest_reach().box_at(rows);
  const bool is_good = graze::is_within_limits(box.min) && graze::is_within_limits(box.max);
  if (pose_ && is_good && mesh_->uses_all_vertices()) return take_pose(rows);
  ReadResult result = accept(scan_pose(rows, 0, mesh_->vertex_count()));
  if (result.changed) write_pose(rows, 0, mesh_->vertex_count());
  if (result.taken()) pose_ = rows;
  return result;
}

/// All vertices are known to be good, and so is how far they move: none of their old positions is read.
Surface::ReadResult Surface::take_pose(const std::array<double, 12>& rows) {
  constexpr std::uint32_t each = 64;  // vertices that stay in a cache until their box is made
  ReadResult result;
  // At rest zeros may have other signs than the identity gives them.
  result.changed = !has_own_positions() || !is_same_pose(*pose_, rows);
  if (!result.changed) {
    count_read(result, box_);
    return result;
  }
  result.displacement = mesh_->rest_reach().motion_between(*pose_, rows);
  own_positions(true);
  PartSeen all;
  const std::uint32_t count = mesh_->vertex_count();
  for (std::uint32_t begin = 0; begin < count; begin += each) {
    const std::uint32_t end = std::min(begin + each, count);
    pose_vertices(rows, mesh_->rest().subspan(begin, end - begin), in_double_.data() + begin);
    all.add(survey(*mesh_, in_double_, begin, end));
  }
  count_read(result, all.box);
  pose_ = rows;
  return result;
}

void Surface::write_positions(const PositionView& view, std::uint32_t begin, std::uint32_t end) {
  if (!is_laid_out_like(view)) return write(begin, end, [&](std::uint32_t vertex) { return view[vertex]; });
  const std::size_t each = view.stride_bytes();
  void* const own =
      view.is_double() ? static_cast<void*>(in_double_.data() + begin) : in_float_.data() + begin;
  std::memcpy(own, static_cast<const std::byte*>(view.data()) + begin * each, (end - begin) * each);
}

void Surface::write_pose(const std::array<double, 12>& rows, std::uint32_t begin, std::uint32_t end) {
  write(begin, end, [&](std::uint32_t vertex) { return posed(rows, mesh_->rest()[vertex]); });
}

namespace {

/// The box of points.
template <typename Number>
class PointExtent {
 public:
  PointExtent(const Number* numbers, std::size_t count) : points_(numbers, count) {}

  void add(std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t vertex : vertices) {
      Four x;
      points_.load(vertex, x);
      low_ = GRAZE_PICK(x < low_, x, low_);
      high_ = GRAZE_PICK(x > high_, x, high_);
    }
  }
  [[nodiscard]] Box box() const { return {{low_[0], low_[1], low_[2]}, {high_[0], high_[1], high_[2]}}; }

 private:
  using Four = typename PointRegisters<Number>::Four;
  static constexpr Number beyond = std::numeric_limits<Number>::infinity();
  PointRegisters<Number> points_;
  Four low_{beyond, beyond, beyond, beyond};
  Four high_ = -low_;
};

template <typename Number>
Box box_of(const PositionView& positions, const RegionTree& tree, const Region& region, RefitOf what) {
  PointExtent<Number> extent(static_cast<const Number*>(positions.data()), positions.size());
  extent.add(tree.vertices(region));
  if (what == RefitOf::faces) extent.add(tree.border(region));
  return extent.box();
}

}  // namespace

Box Surface::box_now(const Region& region, RefitOf what) const {
  const RegionTree& tree = mesh_->regions();
  return positions().is_double() ? box_of<double>(positions(), tree, region, what)
                                 : box_of<float>(positions(), tree, region, what);
}

void Surface::refit(RefitOf what) {
  if (motion_since_refit(what) == 0) return;
  begin_refit(what);
  refit_regions(what, 0, mesh_->regions().region_count());
  finish_refit(what);
}

void Surface::begin_refit(RefitOf what) {
  const std::uint32_t count = mesh_->regions().region_count();
  what == RefitOf::radii ? radii_.resize(count) : boxes_to_write(what).resize(count);
  if (what == RefitOf::faces) oriented_boxes_.resize(mesh_->long_regions().count());
}

void Surface::refit_regions(RefitOf what, std::uint32_t begin, std::uint32_t end) {
  if (what == RefitOf::faces) refit_long_leaves(begin, end);
  for (std::uint32_t index = begin; index < end; ++index) {
    const Region& region = mesh_->regions().region(index);
    if (what == RefitOf::radii)
      radii_[index] = radius_now(region);
    else if (region.is_leaf())
      boxes_to_write(what)[index] = box_now(region, what);
  }
}

void Surface::finish_refit(RefitOf what) {
  what == RefitOf::radii ? gather_level_radii() : box_inner_regions(boxes_to_write(what));
  if (what == RefitOf::faces) box_inner_long_regions();
  refits_[static_cast<std::size_t>(what)] = {version_, travel_};
  validate(*this);
}

/// Eq. 2.
double Surface::radius_now(const Region& region) const {
  const Eigen::Vector3d centre = middle(region);
  double radius_squared = 0;
  for (const std::uint32_t vertex : mesh_->regions().vertices(region))
    radius_squared = std::max(radius_squared, (position(vertex) - centre).squaredNorm());
  return std::sqrt(radius_squared);
}

/// Eq. 3.
void Surface::gather_level_radii() {
  const RegionTree& tree = mesh_->regions();
  level_radii_.assign(tree.level_count(), 0);
  for (std::uint32_t index = 0; index < tree.region_count(); ++index) {
    double& radius = level_radii_[tree.region(index).level];
    radius = std::max(radius, radii_[index]);
  }
}

/// Children have higher numbers than their parent, so theirs are already those of now.
void Surface::box_inner_regions(std::vector<Box>& boxes) const {
  const RegionTree& tree = mesh_->regions();
  for (std::uint32_t index = tree.region_count(); index-- > 0;) {
    const Region& region = tree.region(index);
    if (region.is_leaf()) continue;
    Box box;
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      box.add(boxes[region.first_child + child]);
    boxes[index] = box;
  }
}

void Surface::make_blocks() {
  if (has_blocks()) return;
  blocks_.make(mesh_->block_order(), positions());
  blocks_version_ = version_;
}

void Surface::make_stretches() {
  if (has_stretches()) return;
  stretches_.make(positions());
  stretches_version_ = version_;
}

void Surface::forget_bounds() noexcept {
  let_go(radii_);
  let_go(level_radii_);
  let_go(vertex_boxes_);
  let_go(face_boxes_);
  let_go(oriented_boxes_);
  refits_ = {};
  blocks_ = {};
  stretches_ = {};
  blocks_version_ = stretches_version_ = 0;
}

std::size_t Surface::byte_count() const {
  return sizeof(Surface) + bytes_of(in_float_) + bytes_of(in_double_) + bytes_of(radii_) +
         bytes_of(level_radii_) + bytes_of(vertex_boxes_) + bytes_of(face_boxes_) +
         bytes_of(oriented_boxes_) + blocks_.byte_count() + stretches_.byte_count();
}

}  // namespace graze
