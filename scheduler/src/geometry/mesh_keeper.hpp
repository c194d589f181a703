#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kept_by_reports.hpp"
#include "geometry/kept_meshes.hpp"
#include "objects/object_store.hpp"

namespace graze {

/// Keeps the meshes of all objects for the reports. A step in which no object came, went or got another mesh
/// shares the list of the last one. Stepping thread only.
class MeshKeeper {
 public:
  explicit MeshKeeper(const ObjectStore& store) : store_(store) {}

  /// The meshes of now, after positions were read.
  [[nodiscard]] KeptHandle<KeptMeshes> keep();
  /// Bytes of all lists, those that reports show included. Meshes are not counted.
  [[nodiscard]] std::size_t byte_count() const { return byte_count_; }

 private:
  const ObjectStore& store_;
  KeptPool<KeptMeshes> lists_;
  std::uint64_t seen_arrival_ = 0;     ///< that of the next object, at the last list
  std::uint64_t seen_departures_ = 0;  ///< ObjectStore::arrivals_and_departures, then
  std::size_t byte_count_ = 0;
};

}  // namespace graze
