#pragma once

#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <memory>
#include <string>

namespace graze::io {

/// @addtogroup io_scenes
/// @{

/// An object of a scene, with the name that files and people know it by. Reports in files name an object by
/// its index in a list of these.
struct SceneObject {
  /// The id that Scene::add() gave.
  ObjectId id;
  /// The name of the object.
  std::string name;
  /// The mesh that the object was added with.
  std::shared_ptr<const Mesh> mesh;
};

/// @}

}  // namespace graze::io
