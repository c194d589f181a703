#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/kept_by_reports.hpp"
#include "base/task_pool.hpp"
#include "objects/object_bytes.hpp"
#include "objects/object_store.hpp"
#include "objects/object_summary.hpp"
#include "pairs/pair_filter.hpp"
#include "patches/kept_patches.hpp"
#include "patches/patch_sources.hpp"
#include "patches/patch_tool.hpp"

namespace graze {

/// Keeps what lies around the objects that ask for patches, for the reports. Stepping thread only.
class PatchKeeper {
 public:
  PatchKeeper(TaskPool& tasks, ObjectStore& store) : tasks_(tasks), store_(store) {}

  /// The objects that ask, after positions were read.
  [[nodiscard]] std::span<Object* const> tools();
  /// The patches of now, once all objects near a tool were read, and after `tools`. Nothing if no object
  /// asks.
  [[nodiscard]] KeptHandle<KeptPatches> keep(const ObjectSummaries& summaries, const PairFilter& filter);
  /// Those of the last step, which were made of the same positions.
  [[nodiscard]] KeptHandle<KeptPatches> last() const {
    return tools_.empty() ? KeptHandle<KeptPatches>() : patches_.last();
  }
  /// Bytes of all copies, those that reports show included. Meshes are not counted.
  [[nodiscard]] std::size_t byte_count() const { return byte_count_; }

 private:
  void list_tools();
  void refit_near();
  void find_leaves();
  void copy_near();
  void fill(KeptPatches& patches);
  void count_bytes();

  TaskPool& tasks_;
  ObjectStore& store_;
  std::vector<std::unique_ptr<PatchTool>> tools_;  ///< in the order of addition
  std::vector<Object*> objects_;                   ///< of these
  std::uint64_t listed_at_ = 0;     ///< ObjectStore::arrivals_and_departures, when they were listed
  std::uint64_t seen_arrival_ = 0;  ///< that of the next object, then
  PatchSources sources_;
  std::vector<Object*> to_refit_;
  KeptPool<KeptPatches> patches_;
  std::size_t byte_count_ = 0;
};

}  // namespace graze
