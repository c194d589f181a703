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

/// A part of a file by its number or by its name.
using NumberOrName = std::variant<std::uint32_t, std::string>;

/// An axis that points up. With z up, x points right and y away from the viewer. With y up, x points right
/// and z towards the viewer. With x up, y points left and z towards the viewer.
enum class UpAxis : std::uint8_t { x, y, z };

/// One entry of a scene's `objects`: what to load, how it moves, what it may touch. An entry without `node`
/// whose file holds several objects stands for all of them.
struct ObjectDescription {
  std::string name;            ///< empty: the file's own name for the object
  std::filesystem::path mesh;  ///< as it can be opened: already relative to the scene file
  std::optional<NumberOrName> node;
  Motion motion = Motion::rigid;
  std::filesystem::path positions;        ///< a numbered sequence or a vertex cache; empty: none
  std::optional<NumberOrName> animation;  ///< an animation of the mesh file itself
  bool animate_where_possible = false;    ///< the first animation for each object that the file animates
  std::optional<UpAxis> up;               ///< which axis of the file points up; none: axes are left alone
  bool up_is_the_files = false;           ///< `up` is what the file says
  std::optional<double> metres_per_unit;  ///< the length of 1 in the file; none: lengths are left alone
  bool unit_is_the_files = false;         ///< `metres_per_unit` is what the file says
  Placement transform;
  std::vector<KeyPose> poses;  ///< ascending by frame
  std::uint32_t layer = 1;
  std::uint32_t collides_with = ~std::uint32_t{0};
  std::uint32_t group = 0;
  double margin = 0;
  std::uint32_t kind = 0;
  std::string place;  ///< where this entry stands, for errors: `scene.json: objects[2]`
};

/// Thresholds for a kind of pair; what it leaves out is the scene's.
struct RuleDescription {
  std::array<std::uint32_t, 2> kinds{};
  std::optional<double> contact_distance;
  std::optional<double> range;
  std::vector<double> epsilon;
};

/// Objects that are not looked at together, each by an entry's name or by an object's own.
struct IgnoreDescription {
  std::array<std::string, 2> names;
  std::string place;  ///< for errors
};

/// A scene as its file says it: nothing loaded yet.
struct SceneDescription {
  std::string file;  ///< what errors call the scene
  SceneSettings settings;
  std::optional<std::uint32_t> frames;  ///< none: as long as the longest motion
  double frames_per_second = 30;
  UpAxis up = UpAxis::z;       ///< which axis of the scene points up
  double metres_per_unit = 1;  ///< the length of 1 in the scene
  std::vector<ObjectDescription> objects;
  std::vector<RuleDescription> rules;
  std::vector<IgnoreDescription> ignore;
};

/// Reads the scene file described in docs/formats.md. Throws InputError for a file that cannot be read, JSON
/// that does not parse (with line and column), unknown, repeated or missing keys, wrong types and values out
/// of range, each named by its place.
GRAZE_API SceneDescription read_scene_file(const std::filesystem::path& path);

/// The scene of all objects of some mesh files, each at rest, or playing its file's first animation where it
/// has one.
GRAZE_API SceneDescription scene_of_meshes(const std::vector<std::filesystem::path>& files);

/// `none`, `closest`, `regions`, `vertices` or `features`; nothing for another word.
GRAZE_API std::optional<ContactDetail> contact_detail_from(std::string_view word);
GRAZE_API std::string_view to_string(ContactDetail detail);

}  // namespace graze::io
