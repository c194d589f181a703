#include "jobs/region_refit.hpp"

#include "core/base/bytes_of.hpp"
#include "core/base/cut_by_work.hpp"
#include "core/pair/pair_query.hpp"

namespace graze {
namespace {

/// The bounds of regions are refitted once vertices may have moved by this part of a leaf's size.
constexpr double stale_leaf_sizes = 0.25;
/// The corresponding part for an object whose regions no job walked in the last step. If a job walks them in
/// this step, it finds looser bounds once.
constexpr double stale_leaf_sizes_unwalked = 2;

/// A small object whose face boxes at least this many jobs need is refitted whenever it has moved. Otherwise
/// each job would make the boxes of its leaves for itself. For vertices most jobs use stretches instead.
constexpr std::size_t jobs_worth_a_refit = 3;

/// If few jobs test a large surface, and together need less than this share of its box, each makes blocks of
/// its own part.
constexpr std::size_t most_jobs_in_part = 8;
constexpr double most_shares_in_part = 0.25;

/// The number of vertices and faces of a large surface that one task processes, which takes some tens of
/// microseconds.
constexpr std::size_t work_each = 8192;

/// Whether a pair is answered by a list of an earlier step, which needs no boxes or blocks. Once nothing is
/// in contact, the search for closest points uses the leaves of a front, or bounds at most as loose as the
/// list allows. For vertices that search needs blocks.
bool is_by_list(const PairJob& job, bool with_blocks) {
  const Surface& a = job.a->surface();
  const Surface& b = job.b->surface();
  const double threshold = job.thresholds.threshold;
  if (job.task != PairJob::Task::detect) return false;
  const NearList* const near = job.memory->front.list_for(a, b, threshold);
  if (near == nullptr || !with_blocks) return near != nullptr;
  const bool asks_contacts_alone = !job.was_in_contact() && job.thresholds.reach <= threshold;
  return asks_contacts_alone || near->has_vertices_within(a, b, threshold);
}

/// The share of the volume of `box` that `part` takes. A side of length 0 does not count.
double share_of(const Box& box, const Box& part) {
  if (part.empty()) return 0;
  double share = 1;
  for (int axis = 0; axis < 3; ++axis)
    if (box.max[axis] > box.min[axis])
      share *= (part.max[axis] - part.min[axis]) / (box.max[axis] - box.min[axis]);
  return share;
}

/// The number of vertices and border faces from which a region's bounds are made. The boxes of inner regions
/// come from their children instead.
std::uint32_t work_of(const Region& region, RefitOf what) {
  if (what != RefitOf::radii && !region.is_leaf()) return 0;
  return region.vertex_count + (what == RefitOf::faces ? region.border_count : 0);
}

/// About how long a vertex takes on one thread: its share of the boxes of faces, of blocks, and of the boxes
/// of inner regions.
constexpr double nanoseconds_each_bound = 25;
constexpr double nanoseconds_each_block = 5;
constexpr double nanoseconds_each_inner_bound = 0.5;

/// About how long these objects take on one thread.
double nanoseconds_of(std::span<Object* const> objects, double nanoseconds_each_vertex) {
  std::size_t vertices = 0;
  for (const Object* const object : objects) vertices += object->mesh->vertex_count();
  return nanoseconds_each_vertex * static_cast<double>(vertices);
}

}  // namespace

RegionRefit::RegionRefit(const SceneSettings& settings, TaskPool& tasks, ObjectBytes& bytes)
    : tasks_(tasks),
      bytes_(bytes),
      boxes_(boxes_for(settings.detail)),
      with_blocks_(wants_blocks(settings.detail, settings.accuracy.mode())),
      needs_paper_bounds_(settings.accuracy.mode() == AccuracyMode::paper || settings.region_distances > 0) {}

void RegionRefit::run(std::span<const PairJob> jobs) {
  if (with_blocks_ && !needs_paper_bounds_) {
    list_objects(jobs, boxes_);
  } else {
    refit(jobs, boxes_);
    if (with_radii()) refit(jobs, RefitOf::radii);
  }
  if (with_blocks_) make_blocks();
}

/// Makes blocks or stretches of all objects listed last.
void RegionRefit::make_blocks() {
  const auto make = [this](unsigned, std::size_t item) {
    const AccessScope access({AccessRight::write(objects_[item]), {}});
    Surface& surface = objects_[item]->surface_to_write();
    is_seen_in_part(*objects_[item]) ? surface.make_stretches() : surface.make_blocks();
    bytes_.count(*objects_[item]);
  };
  tasks_.run(objects_.size(), make, {.nanoseconds = nanoseconds_of(objects_, nanoseconds_each_block)});
}

/// Whether jobs make blocks of their own parts of an object. They do not if the object has blocks already.
/// Nor do they if stretches of an earlier step are still valid: then the object has not moved, and blocks of
/// all of it are better.
bool RegionRefit::is_seen_in_part(const Object& object) {
  const Surface& surface = object.surface();
  return surface.mesh().has_stretches() && !surface.has_blocks() && !surface.has_stretches() &&
         object.asked.jobs <= most_jobs_in_part && object.asked.shares < most_shares_in_part;
}

void RegionRefit::refit(std::span<const PairJob> jobs, RefitOf what) {
  list_objects(jobs, what);
  parts_.clear();
  for (Object* const object : large_) {
    object->surface_to_write().begin_refit(what);
    list_parts(*object, what);
  }
  // A task writes the bounds of its own object, or of its own regions of an object.
  const auto refit_one = [this, what](unsigned, std::size_t item) {
    if (item >= parts_.size()) return refit_small(*small_[item - parts_.size()], what);
    const Part& part = parts_[item];
    const AccessScope access({AccessRight::write(part.object), {}});
    part.object->surface_to_write().refit_regions(what, part.begin, part.end);
  };
  tasks_.run(parts_.size() + small_.size(), refit_one,
             {.nanoseconds = nanoseconds_of(small_, nanoseconds_each_bound) +
                             nanoseconds_of(large_, nanoseconds_each_bound)});
  tasks_.run(large_.size(),
             [&](unsigned, std::size_t index) {
               const AccessScope access({AccessRight::write(large_[index]), {}});
               large_[index]->surface_to_write().finish_refit(what);
               bytes_.count(*large_[index]);
             },
             {.nanoseconds = nanoseconds_of(large_, nanoseconds_each_inner_bound)});
}

void RegionRefit::prepare(Surface& surface) const {
  surface.refit(boxes_);
  if (with_blocks_) surface.make_blocks();
  if (with_blocks_ && surface.mesh().has_stretches()) surface.make_stretches();
  if (with_radii()) surface.refit(RefitOf::radii);
}

void RegionRefit::count_job(Object& object, const Object& other, const PairJob& job) {
  if (object.asked.refit != refits_) {
    object.asked = {refits_, 0, false, 0};
    if (with_blocks_) object.demand = Demand::blocks;
    objects_.push_back(&object);
  }
  ++object.asked.jobs;
  object.asked.walked = object.asked.walked || job.memory->front.walked;
  if (object.in_parts)
    object.asked.shares +=
        share_of(object.surface().box(),
                 common(object.surface().box(), grown(other.surface().box(), job.thresholds.threshold)));
}

void RegionRefit::list_objects(std::span<const PairJob> jobs, RefitOf what) {
  ++refits_;
  objects_.clear();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    prefetch_ahead(jobs, i, &Object::asked);
    const PairJob& job = jobs[i];
    if (job.is_tested() && (needs_paper_bounds_ || !is_by_list(job, with_blocks_)))
      for (const auto& [object, other] : {std::pair(job.a, job.b), {job.b, job.a}})
        count_job(*object, *other, job);
  }
  small_.clear();
  large_.clear();
  for (Object* const object : objects_)
    if (!object->in_parts)
      small_.push_back(object);
    else if (is_stale(*object, what))
      large_.push_back(object);
}

void RegionRefit::reserve(std::size_t jobs) {
  objects_.reserve(2 * jobs);
  small_.reserve(2 * jobs);
  large_.reserve(2 * jobs);
}

std::size_t RegionRefit::byte_count() const {
  return bytes_of(objects_) + bytes_of(small_) + bytes_of(large_) + bytes_of(parts_);
}

bool RegionRefit::is_stale(const Object& object, RefitOf what) const {
  const Surface& surface = object.surface();
  const double allowed = object.asked.walked ? stale_leaf_sizes : stale_leaf_sizes_unwalked;
  return surface.motion_since_refit(what) > (needs_paper_bounds_ ? 0 : allowed * surface.leaf_size());
}

void RegionRefit::list_parts(Object& object, RefitOf what) {
  const RegionTree& tree = object.surface().mesh().regions();
  cut_by_work(
      0, tree.region_count(), work_each,
      [&](std::size_t index) { return work_of(tree.regions()[index], what); },
      [&](std::size_t begin, std::size_t end) {
        parts_.push_back({&object, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
      });
}

void RegionRefit::refit_small(Object& object, RefitOf what) const {
  const AccessScope access({AccessRight::write(&object), {}});
  Surface& surface = object.surface_to_write();
  const bool is_asked_often = object.asked.jobs >= jobs_worth_a_refit;
  if (!(is_asked_often && what == RefitOf::faces) && !is_stale(object, what)) return;
  surface.refit(what);
  bytes_.count(object);
}

}  // namespace graze
