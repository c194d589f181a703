#pragma once

#include <Eigen/Geometry>
#include <graze/io/motion.hpp>
#include <graze/io/scene_file.hpp>
#include <graze/mesh.hpp>
#include <memory>
#include <string>
#include <vector>

namespace graze::io {

/// One object of a described scene with its files loaded, not yet in a Scene.
struct LoadedSceneObject {
  std::size_t entry = 0;  ///< into SceneDescription::objects
  ObjectSettings settings;
  /// With the file's axes and unit converted. It is scaled where rigid or fixed, wholly placed where
  /// deformable.
  std::shared_ptr<const Mesh> mesh;
  std::unique_ptr<PositionSource> source;                   ///< positions before `placement`. Null means none
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< takes what `source` reads to the scene
};

struct LoadedScene {
  std::vector<LoadedSceneObject> objects;
  std::vector<std::string> warnings;
};

/// Loads every mesh and opens every motion, each file once. Throws InputError.
LoadedScene load_scene(const SceneDescription& description);

}  // namespace graze::io
