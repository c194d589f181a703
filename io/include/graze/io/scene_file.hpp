#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/keyframes.hpp>
#include <graze/settings.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace graze::io {

/// @addtogroup io_scenes
/// @{

/// Names a part of a mesh file, either by its number from 0 or by its name.
using NumberOrName = std::variant<std::uint32_t, std::string>;

/// Says which axis points up.
enum class UpAxis : std::uint8_t {
  x,  ///< x points up, y points left, and z points towards the viewer.
  y,  ///< y points up, x points right, and z points towards the viewer.
  z,  ///< z points up, x points right, and y points away from the viewer.
};

/// Returns the enumerator's own name, such as "z". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(UpAxis axis) {
  switch (axis) {
    case UpAxis::x:
      return "x";
    case UpAxis::y:
      return "y";
    case UpAxis::z:
      return "z";
  }
  return {};
}

/// One entry of a scene's `objects`: what to load, how it moves, and what it may touch. An entry without
/// #node whose file holds several objects stands for all of them.
struct ObjectDescription {
  /// The settings of each object of this entry. If ObjectSettings::name is empty, the file's own name for the
  /// object counts. In a scene file, an entry without `motion` is rigid, unless #positions or #animation move
  /// it.
  ObjectSettings settings;
  /// The mesh file, as a path that can be opened. A path in a scene file is relative to the scene file.
  std::filesystem::path mesh;
  /// The object of the file. No value means all of them.
  std::optional<NumberOrName> node;
  /// A numbered sequence or a vertex cache with the positions of a deformable object. Empty means none.
  std::filesystem::path positions;
  /// An animation of the mesh file that moves a deformable object. No value means none.
  std::optional<NumberOrName> animation;
  /// True plays the first animation of the file for each object that an animation moves.
  bool animate_where_possible = false;
  /// The axis of the file that points up. No value means that axes are left alone.
  std::optional<UpAxis> up;
  /// True means that #up is the axis that the file says.
  bool up_is_the_files = false;
  /// The length of 1 in the file, in metres. No value means that lengths are left alone.
  std::optional<double> metres_per_unit;
  /// True means that #metres_per_unit is the unit that the file says.
  bool unit_is_the_files = false;
  /// The place, the rotation and the scale of the object.
  Placement transform;
  /// The poses of a rigid object, ascending by frame. If there are none, it stands at #transform.
  std::vector<KeyPose> poses;
  /// How errors name this entry, such as `scene.json: objects[2]`.
  std::string place;
};

/// Thresholds for the pairs of two kinds of objects.
struct RuleDescription : PairRule {
  /// The two kinds of objects, each 0 to 255, in either order.
  std::array<std::uint32_t, 2> kinds{};
};

/// Two sets of objects that are not tested together.
struct IgnoreDescription {
  /// Two names. The name of an entry stands for all of its objects. Other names are those of single objects.
  std::array<std::string, 2> names;
  /// The groups of faces that are not tested together, see Scene::ignore(). No value means whole objects.
  std::optional<std::array<std::uint8_t, 2>> groups;
  /// How errors name this entry.
  std::string place;
};

/// A scene as its file describes it. No mesh is loaded yet: Player does that.
struct SceneDescription {
  /// How errors name the scene.
  std::string file;
  /// The settings of the scene.
  SceneSettings settings;
  /// The number of frames. No value means as many as the longest motion has.
  std::optional<std::uint32_t> frames;
  /// The rate at which animations of mesh files are sampled.
  double frames_per_second = 30;
  /// The axis of the scene that points up. It matters only to objects that have ObjectDescription::up.
  UpAxis up = UpAxis::z;
  /// The length of 1 in the scene, in metres. It matters only to objects that have
  /// ObjectDescription::metres_per_unit.
  double metres_per_unit = 1;
  /// The entries of the scene's objects, at least one.
  std::vector<ObjectDescription> objects;
  /// Thresholds for kinds of pairs.
  std::vector<RuleDescription> rules;
  /// Pairs that are not tested.
  std::vector<IgnoreDescription> ignore;
  /// Whether mesh files may name files outside their own folders, see ReadOptions::outside_files.
  bool outside_files = false;
};

/// Reads a scene file. docs/formats.md describes the format.
///
/// Throws InputError if the file cannot be read, or if its JSON does not parse, with line and column. Also
/// throws InputError for a key that is unknown, repeated or missing, and for a value of a wrong type or out
/// of range. The message says where in the file it stands.
GRAZE_API SceneDescription read_scene_file(const std::filesystem::path& path);

/// Describes a scene of all objects of some mesh files. An object that an animation of its file moves plays
/// the first animation. Every other object is at rest.
GRAZE_API SceneDescription scene_of_meshes(const std::vector<std::filesystem::path>& files);

/// @}

}  // namespace graze::io
