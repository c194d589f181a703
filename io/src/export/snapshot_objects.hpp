#pragma once

#include <Eigen/Core>
#include <graze/io/scene_snapshot.hpp>
#include <unordered_map>

namespace graze::io {

/// Finds the objects that a report names, those that were just removed too.
class SnapshotObjects {
 public:
  /// The snapshot must outlive this.
  explicit SnapshotObjects(const SceneSnapshot& snapshot);

  /// The object of an id, or null.
  [[nodiscard]] const SnapshotObject* find(ObjectId id) const;

 private:
  std::unordered_map<ObjectId, const SnapshotObject*> by_id_;
};

/// A position of an object. A vertex that no face uses may hold anything, so it counts as standing where the
/// first corner of the first face does.
const Eigen::Vector3d& exported_position(const SnapshotObject& object, std::uint32_t vertex);

}  // namespace graze::io
