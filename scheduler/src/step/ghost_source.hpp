#pragma once

#include "base/task_pool.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"

namespace graze {

/// Brings ghosts into each step of a scene: copies of objects that belong to other processes. Stepping thread
/// only.
class GhostSource {
 public:
  virtual ~GhostSource() = default;
  /// Sees what a step has read, and adds, moves and removes ghosts. If it throws, the step fails.
  virtual void bring(ObjectStore& store, PairFilter& filter, TaskPool& tasks) = 0;
};

}  // namespace graze
