#pragma once

#include <graze/settings.hpp>

#include "base/task_pool.hpp"
#include "core/pair/pair_query.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"

namespace graze {

/// What a scene holds whatever its steps remember: its objects, which of their pairs are looked at, what room
/// was reserved. It is whole also after a step that came to no end. Stepping thread only.
struct SceneContent {
  explicit SceneContent(const SceneSettings& settings)
      : tasks(settings.threads, settings.arena),
        store(wants_blocks(settings.detail, settings.accuracy.mode()) && settings.region_distances == 0),
        filter(settings) {}

  TaskPool tasks;
  ObjectStore store;
  PairFilter filter;
  SceneCapacity reserved;  ///< of every number the largest for which there was memory
};

}  // namespace graze
