#include "patches/patch_tool.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// Whether the surface of an object has its positions. A frozen object may stand at a place that was only
/// viewed or surveyed, or may have no place yet.
bool is_known(const Object& object) {
  if (object.is_unread()) return false;
  return !object.frozen ||
         (object.seen.is_in_surface && !object.surface().is_behind() && !object.is_unplaced);
}

}  // namespace

void PatchTool::list_near(std::span<const std::unique_ptr<Object>> objects, const ObjectSummaries& summaries,
                          const PairFilter& filter) {
  near_.clear();
  threshold_ = 0;
  known_radius_ = is_known(object_) ? object_.settings.patch_radius : -1;
  const std::uint32_t slot = summaries.slot_of(object_);
  const ObjectSummary& tool = summaries[slot];
  if (tool.hidden) return;
  for (std::uint32_t other = 0; other < objects.size(); ++other) {
    const ObjectSummary& summary = summaries[other];
    if (other == slot || summary.hidden || filter.verdict(tool, summary) != PairVerdict::tested) continue;
    const auto [first, second] = std::minmax(slot, other);
    threshold_ = std::max(threshold_, filter.thresholds(summaries[first], summaries[second]).threshold);
    const double lower = lower_distance(tool.box, summary.box);
    if (lower > object_.settings.patch_radius) continue;
    if (!is_known(*objects[other])) {
      known_radius_ = std::min(known_radius_, lower);
      continue;
    }
    near_.push_back({objects[other].get(), filter.groups(summaries[first], summaries[second])});
  }
}

void PatchTool::find_leaves() {
  copy_surface();
  copy_ignored();
  const Surface& about = copies_.last()->surface;
  radius_ = known_radius_;
  cut_ = false;
  found_.clear();
  for (std::size_t index = 0; index < near_.size(); ++index) {
    const Surface& surface = near_[index].object->surface();
    leaves_.clear();
    list_near_leaves(about, object_.settings.solid, surface, std::max(radius_, 0.0), leaves_);
    for (const NearLeaf& leaf : leaves_)
      found_.push_back({leaf, index, surface.mesh().regions().region(leaf.leaf).face_count});
  }
  cut();
  std::sort(found_.begin(), found_.end(), [](const FoundLeaf& left, const FoundLeaf& right) {
    return std::tie(left.near, left.leaf.leaf) < std::tie(right.near, right.leaf.leaf);
  });
  leaves_.clear();
  for (const FoundLeaf& found : found_) {
    Near& near = near_[found.near];
    if (near.leaf_count++ == 0) near.first_leaf = leaves_.size();
    leaves_.push_back(found.leaf);
  }
}

void PatchTool::copy_surface() {
  const Surface& from = object_.surface();
  if (version_ == from.version() && copies_.has_last_of(object_.users_mesh)) return;
  copies_.next(object_.users_mesh).surface.copy_refitted(from);
  version_ = from.version();
}

void PatchTool::copy_ignored() {
  ignored_.begin();
  for (Near& near : near_)
    if (near.groups.filter != nullptr) near.ignored = ignored_.of(object_, *near.object, near.groups);
}

/// Leaves out the furthest leaves where there are more faces than a patch may have.
void PatchTool::cut() {
  std::size_t faces = 0;
  for (const FoundLeaf& found : found_) faces += found.faces;
  if (faces <= object_.settings.patch_faces) return;
  std::sort(found_.begin(), found_.end(), [](const FoundLeaf& left, const FoundLeaf& right) {
    return std::tie(left.leaf.lower, left.near, left.leaf.leaf) <
           std::tie(right.leaf.lower, right.near, right.leaf.leaf);
  });
  std::size_t kept = 0;
  faces = 0;
  while (faces + found_[kept].faces <= object_.settings.patch_faces) faces += found_[kept++].faces;
  radius_ = std::min(radius_, found_[kept].leaf.lower);
  cut_ = true;
  found_.resize(kept);
}

void PatchTool::ask(PatchSources& sources) const {
  for (const Near& near : near_)
    if (is_there(near)) sources.ask(*near.object, leaves_of(near));
}

void PatchTool::fill(const PatchSources& sources, KeptPatch& patch) const {
  patch.tool = object_.id;
  patch.solid = object_.settings.solid;
  patch.surface = copies_.last();
  patch.groups = object_.hides_some_faces() ? object_.face_groups : nullptr;
  patch.radius = radius_;
  patch.cut = cut_;
  patch.threshold = threshold_;
  for (const Near& near : near_) {
    if (!is_there(near)) continue;
    KeptPatchObject kept = kept_of(near, sources);
    kept.first_face = patch.faces.size();
    add_faces(near, patch.faces);
    kept.face_count = patch.faces.size() - kept.first_face;
    patch.ids.push_back(kept.id);
    patch.objects.push_back(std::move(kept));
  }
}

/// What the patch keeps of an object, but for its faces.
KeptPatchObject PatchTool::kept_of(const Near& near, const PatchSources& sources) const {
  const Object& object = *near.object;
  KeptPatchObject kept;
  kept.id = object.id;
  kept.is_first = object.serial < serial_;
  kept.solid = object.settings.solid;
  kept.surface = sources.copy_of(object);
  if (object.hides_some_faces()) kept.groups = object.face_groups;
  kept.ignored = near.ignored;
  return kept;
}

void PatchTool::add_faces(const Near& near, std::vector<std::uint32_t>& faces) const {
  const RegionTree& tree = near.object->mesh->regions();
  const auto first = static_cast<std::ptrdiff_t>(faces.size());
  for (const NearLeaf& leaf : leaves_of(near)) {
    const auto of_leaf = tree.faces(tree.region(leaf.leaf));
    faces.insert(faces.end(), of_leaf.begin(), of_leaf.end());
  }
  std::sort(faces.begin() + first, faces.end());
}

std::size_t PatchTool::byte_count() const {
  std::size_t bytes = sizeof(PatchTool) + bytes_of(copies_.all()) + bytes_of(near_) + bytes_of(leaves_) +
                      bytes_of(found_) + ignored_.byte_count();
  for (const auto& copy : copies_.all()) bytes += sizeof(KeptSurface) + copy->surface.byte_count();
  return bytes;
}

}  // namespace graze
