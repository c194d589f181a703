#pragma once

#include <graze/settings.hpp>
#include <memory>
#include <utility>

#include "base/task_pool.hpp"
#include "core/pair/pair_query.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"

namespace graze {

/// The part of a scene that does not depend on what steps remember: its objects, its filters, and the
/// reserved capacity. It stays whole after a failed step. Stepping thread only.
struct SceneContent {
  SceneContent(const SceneSettings& settings, std::shared_ptr<TaskScheduler> scheduler)
      : tasks(settings.threads, settings.arena, std::move(scheduler)),
        store(wants_blocks(settings.detail, settings.accuracy.mode()) && settings.region_distances == 0),
        filter(settings) {}

  TaskPool tasks;
  ObjectStore store;
  PairFilter filter;
  SceneCapacity reserved;  ///< the largest of each number for which there was memory
};

}  // namespace graze
