#pragma once

#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <memory>
#include <string>

namespace graze::io {

/// An object of a scene under the name that files and people know it by. Its number in a report is its place
/// in the list of these.
struct SceneObject {
  ObjectId id;
  std::string name;
  std::shared_ptr<const Mesh> mesh;
};

}  // namespace graze::io
