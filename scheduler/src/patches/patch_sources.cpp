#include "patches/patch_sources.hpp"

#include <algorithm>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// About how long it takes on one thread to copy a vertex and to box it.
constexpr double nanoseconds_each_copied = 8;

}  // namespace

void PatchSources::begin(const ObjectStore& store) {
  if (listed_at_ != store.arrivals_and_departures()) {
    std::erase_if(sources_,
                  [&](const Source& source) { return store.find_serial(source.serial) == nullptr; });
    listed_at_ = store.arrivals_and_departures();
  }
  for (Source& source : sources_) {
    source.is_asked_for = false;
    source.leaves.clear();
  }
}

/// The index of an object's source, or where it would be.
std::size_t PatchSources::index_of(const Object& object) const {
  const auto found =
      std::lower_bound(sources_.begin(), sources_.end(), object.serial,
                       [](const Source& source, std::uint64_t serial) { return source.serial < serial; });
  return static_cast<std::size_t>(found - sources_.begin());
}

PatchSources::Source& PatchSources::source_of(const Object& object) {
  const std::size_t index = index_of(object);
  if (index == sources_.size() || sources_[index].serial != object.serial) {
    Source made;
    made.object = &object;
    made.serial = object.serial;
    sources_.insert(sources_.begin() + static_cast<std::ptrdiff_t>(index), std::move(made));
  }
  return sources_[index];
}

void PatchSources::ask(const Object& object, std::span<const NearLeaf> leaves) {
  Source& source = source_of(object);
  source.is_asked_for = true;
  if (object.settings.solid) return;
  for (const NearLeaf& leaf : leaves) source.leaves.push_back(leaf.leaf);
}

/// Whether the last copy is not what was asked for. Puts the leaves in order.
bool PatchSources::is_outdated(Source& source) {
  auto& leaves = source.leaves;
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return source.version != source.object->surface().version() ||
         !source.copies.has_last_of(source.object->users_mesh) || source.copied != leaves;
}

void PatchSources::copy(TaskPool& tasks) {
  to_copy_.clear();
  double nanoseconds = 0;
  for (Source& source : sources_) {
    if (!source.is_asked_for || !is_outdated(source)) continue;
    (void)source.copies.next(source.object->users_mesh);
    to_copy_.push_back(&source);
    const auto vertices = source.object->settings.solid ? std::size_t{source.object->mesh->vertex_count()}
                                                        : source.leaves.size() * RegionTree::leaf_capacity;
    nanoseconds += nanoseconds_each_copied * static_cast<double>(vertices);
  }
  tasks.run(to_copy_.size(), [&](unsigned /*worker*/, std::size_t item) { fill(*to_copy_[item]); },
            {.nanoseconds = nanoseconds});
}

/// A task writes the copy of its own object.
void PatchSources::fill(Source& source) {
  const AccessScope scope({AccessRight::read(), {}});
  const Surface& from = source.object->surface();
  SurfacePart& part = source.copies.last()->part;
  source.object->settings.solid ? part.take_all(from) : part.take(from, source.leaves);
  source.copied = source.leaves;
  source.version = from.version();
}

std::size_t PatchSources::byte_count() const {
  std::size_t bytes = bytes_of(sources_) + bytes_of(to_copy_);
  for (const Source& source : sources_) {
    bytes += bytes_of(source.leaves) + bytes_of(source.copied) + bytes_of(source.copies.all());
    for (const auto& copy : source.copies.all()) bytes += sizeof(PatchSurface) + copy->part.byte_count();
  }
  return bytes;
}

}  // namespace graze
