#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/task_pool.hpp"
#include "core/surface/near_leaves.hpp"
#include "geometry/spare_copies.hpp"
#include "objects/object_store.hpp"
#include "patches/kept_patches.hpp"

namespace graze {

/// The objects that patches have copies of, each copied once for all tools of a step. Copies are kept for as
/// long as the object is in the scene, so that coming near a tool again takes no memory. Stepping thread
/// only.
class PatchSources {
 public:
  /// Begins a step, in which no object is asked for yet.
  void begin(const ObjectStore& store);
  /// Asks for leaves of an object, or for all of a solid.
  void ask(const Object& object, std::span<const NearLeaf> leaves);
  /// Copies what was asked for. A surface that has not moved, and of which the same was asked for in the last
  /// step, is shared with that step.
  void copy(TaskPool& tasks);
  /// The copy of an object that was asked for.
  [[nodiscard]] const std::shared_ptr<PatchSurface>& copy_of(const Object& object) const {
    return sources_[index_of(object)].copies.last();
  }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Source {
    const Object* object = nullptr;
    std::uint64_t serial = 0;
    bool is_asked_for = false;
    std::vector<std::uint32_t> leaves;  ///< ascending, once `copy` has begun. None for a solid
    std::vector<std::uint32_t> copied;  ///< those of the last copy
    std::uint64_t version = 0;          ///< of the object's surface, then
    SpareCopies<PatchSurface> copies;
  };

  [[nodiscard]] std::size_t index_of(const Object& object) const;
  [[nodiscard]] Source& source_of(const Object& object);
  static bool is_outdated(Source& source);
  static void fill(Source& source);

  std::vector<Source> sources_;  ///< ascending by serial
  std::uint64_t listed_at_ = 0;  ///< ObjectStore::arrivals_and_departures, when they were all there
  std::vector<Source*> to_copy_;
};

}  // namespace graze
