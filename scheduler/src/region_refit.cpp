#include "region_refit.hpp"

#include <algorithm>
#include <graze/bytes_of.hpp>
#include <graze/cut_by_work.hpp>
#include <graze/pair_query.hpp>

namespace graze {
namespace {

/// Bounds of regions are made anew when vertices may have moved by this part of a leaf's size.
constexpr double stale_leaf_sizes = 0.25;

/// Vertices and faces of a large surface that one task goes through: some tens of microseconds.
constexpr std::size_t work_each = 8192;

/// What a region's bounds are made from; those of faces from its children, but for leaves.
std::uint32_t work_of(const Region& region, RefitOf what) {
  if (what == RefitOf::vertices) return region.vertex_count;
  return region.is_leaf() ? region.vertex_count + region.face_count : 0;
}

}  // namespace

RegionRefit::RegionRefit(const SceneSettings& settings, TaskPool& tasks)
    : settings_(settings),
      tasks_(tasks),
      what_(is_about_vertices(settings.detail) ? RefitOf::vertices : RefitOf::faces) {}

void RegionRefit::run(std::span<const PairJob> jobs) {
  list_objects(jobs);
  parts_.clear();
  for (Object* const object : large_) {
    object->surface_to_write().begin_refit(what_);
    list_parts(*object);
  }
  // A task writes the bounds of its own object, or of its own regions of one.
  tasks_.run(parts_.size() + small_.size(), [&](unsigned, std::size_t item) {
    if (item >= parts_.size()) return refit_small(*small_[item - parts_.size()]);
    const Part& part = parts_[item];
    const AccessScope access({AccessRight::write(part.object), {}});
    part.object->surface_to_write().refit_regions(what_, part.begin, part.end);
  });
  tasks_.run(large_.size(), [&](unsigned, std::size_t index) {
    const AccessScope access({AccessRight::write(large_[index]), {}});
    large_[index]->surface_to_write().finish_refit(what_);
  });
}

/// Each once, however many jobs look at it.
void RegionRefit::list_objects(std::span<const PairJob> jobs) {
  small_.clear();
  large_.clear();
  for (const PairJob& job : jobs)
    if (job.is_looked_at())
      for (Object* const object : {job.a, job.b}) (object->in_parts ? large_ : small_).push_back(object);
  for (std::vector<Object*>* const list : {&small_, &large_}) {
    std::sort(list->begin(), list->end(),
              [](const Object* left, const Object* right) { return left->serial < right->serial; });
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  std::erase_if(large_, [&](const Object* object) { return !is_stale(object->surface()); });
}

void RegionRefit::reserve(std::size_t jobs) {
  small_.reserve(2 * jobs);
  large_.reserve(2 * jobs);
}

std::size_t RegionRefit::byte_count() const {
  return bytes_of(small_) + bytes_of(large_) + bytes_of(parts_);
}

bool RegionRefit::is_stale(const Surface& surface) const {
  const bool to_the_letter =
      settings_.accuracy.mode() == AccuracyMode::paper || settings_.region_distances > 0;
  return surface.motion_since_refit(what_) > (to_the_letter ? 0 : stale_leaf_sizes * surface.leaf_size());
}

void RegionRefit::list_parts(Object& object) {
  const RegionTree& tree = object.surface().mesh().regions();
  cut_by_work(
      0, tree.region_count(), work_each,
      [&](std::size_t index) { return work_of(tree.regions()[index], what_); },
      [&](std::size_t begin, std::size_t end) {
        parts_.push_back({&object, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
      });
}

void RegionRefit::refit_small(Object& object) const {
  const AccessScope access({AccessRight::write(&object), {}});
  if (is_stale(object.surface())) object.surface_to_write().refit(what_);
}

}  // namespace graze
