#include "export/snapshot_objects.hpp"

namespace graze::io {

SnapshotObjects::SnapshotObjects(const SceneSnapshot& snapshot) {
  for (const auto* const list : {&snapshot.removed, &snapshot.objects})
    for (const SnapshotObject& object : *list) by_id_[object.id] = &object;
}

const SnapshotObject* SnapshotObjects::find(ObjectId id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : found->second;
}

const Eigen::Vector3d& exported_position(const SnapshotObject& object, std::uint32_t vertex) {
  return object.positions[object.mesh->is_used(vertex) ? vertex : object.mesh->face(0)[0]];
}

}  // namespace graze::io
