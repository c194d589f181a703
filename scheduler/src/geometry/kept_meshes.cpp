#include "geometry/kept_meshes.hpp"

#include <utility>

namespace graze {

void KeptMeshes::set(ObjectId id, std::shared_ptr<const Mesh> mesh) {
  const std::size_t index = id.index / part_size;
  if (index >= parts_.size()) {
    if (mesh == nullptr) return;
    parts_.resize(index + 1);
    own_.resize(index + 1, 0);
  }
  std::shared_ptr<Part>& part = parts_[index];
  if (own_[index] == 0) part = part == nullptr ? std::make_shared<Part>() : std::make_shared<Part>(*part);
  own_[index] = 1;
  Entry& entry = (*part)[id.index % part_size];
  // Two objects may have used one slot after each other, and the one that is gone may be named last.
  if (mesh == nullptr && entry.generation != id.generation) return;
  entry = {id.generation, std::move(mesh)};
}

}  // namespace graze
