#include "patches/patch_keeper.hpp"

#include <algorithm>
#include <functional>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

// About how long each takes on one thread.
constexpr double nanoseconds_each_pair = 10;      // of a tool and an object
constexpr double nanoseconds_each_refitted = 25;  // a vertex
constexpr double nanoseconds_each_tool = 20'000;

}  // namespace

std::span<Object* const> PatchKeeper::tools() {
  if (listed_at_ != store_.arrivals_and_departures()) list_tools();
  return objects_;
}

/// Lists the objects that ask, with what is known of those that were listed before. Others are looked at
/// once.
void PatchKeeper::list_tools() {
  std::erase_if(tools_, [&](const auto& tool) { return store_.find_serial(tool->serial()) == nullptr; });
  store_.visit_arrived(seen_arrival_, [&](Object& object) {
    if (object.settings.patch_radius > 0) tools_.push_back(std::make_unique<PatchTool>(object));
  });
  std::sort(tools_.begin(), tools_.end(),
            [](const auto& left, const auto& right) { return left->serial() < right->serial(); });
  seen_arrival_ = store_.next_arrival();
  objects_.clear();
  for (const auto& tool : tools_) objects_.push_back(&tool->object());
  listed_at_ = store_.arrivals_and_departures();
}

KeptHandle<KeptPatches> PatchKeeper::keep(const ObjectSummaries& summaries, const PairFilter& filter) {
  if (tools_.empty()) return {};
  const auto objects = store_.objects();
  // A task writes what belongs to its own tool.
  const auto list_near = [&](unsigned /*worker*/, std::size_t item) {
    const AccessScope scope({AccessRight::read(), {}});
    tools_[item]->list_near(objects, summaries, filter);
  };
  tasks_.run(tools_.size(), std::ref(list_near),
             {.nanoseconds = nanoseconds_each_pair * static_cast<double>(tools_.size() * objects.size())});
  refit_near();
  find_leaves();
  copy_near();
  fill(patches_.next());
  count_bytes();
  return patches_.last();
}

/// Refits the objects near a tool that no job has refitted.
void PatchKeeper::refit_near() {
  to_refit_.clear();
  for (const auto& tool : tools_)
    tool->visit_near([&](Object& object) {
      if (object.surface().motion_since_face_refit() != 0) to_refit_.push_back(&object);
    });
  std::sort(to_refit_.begin(), to_refit_.end(),
            [](const Object* left, const Object* right) { return left->serial < right->serial; });
  to_refit_.erase(std::unique(to_refit_.begin(), to_refit_.end()), to_refit_.end());
  double nanoseconds = 0;
  for (const Object* const object : to_refit_)
    nanoseconds += nanoseconds_each_refitted * static_cast<double>(object->mesh->vertex_count());
  // A task writes the bounds of its own object.
  const auto refit = [&](unsigned /*worker*/, std::size_t item) {
    Object& object = *to_refit_[item];
    const AccessScope scope({AccessRight::write(&object), {}});
    object.surface_to_write().refit_faces();
    store_.bytes().count(object);
  };
  tasks_.run(to_refit_.size(), refit, {.nanoseconds = nanoseconds});
}

void PatchKeeper::find_leaves() {
  const auto find = [&](unsigned /*worker*/, std::size_t item) {
    const AccessScope scope({AccessRight::read(), {}});
    tools_[item]->find_leaves();
  };
  // Copies that no report has can be filled again.
  patches_.clear_unused();
  tasks_.run(tools_.size(), find,
             {.nanoseconds = nanoseconds_each_tool * static_cast<double>(tools_.size())});
}

void PatchKeeper::copy_near() {
  sources_.begin(store_);
  for (const auto& tool : tools_) tool->ask(sources_);
  sources_.copy(tasks_);
}

void PatchKeeper::fill(KeptPatches& patches) {
  for (const auto& tool : tools_) tool->fill(sources_, patches.add());
}

void PatchKeeper::count_bytes() {
  byte_count_ = bytes_of(tools_) + bytes_of(objects_) + bytes_of(to_refit_) + sources_.byte_count() +
                patches_.byte_count();
  for (const auto& tool : tools_) byte_count_ += tool->byte_count();
}

}  // namespace graze
