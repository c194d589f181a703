#include "scene/scene_loading.hpp"

#include <algorithm>
#include <array>
#include <graze/error.hpp>
#include <graze/io/error.hpp>
#include <graze/io/mesh_file.hpp>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "mesh/axes.hpp"
#include "mesh/known_formats.hpp"
#include "mesh/raw_object.hpp"
#include "text/file_bytes.hpp"
#include "text/text_lines.hpp"
#include "text/unique_names.hpp"

namespace graze::io {
namespace {

std::string list_of(std::span<const std::string> names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : ", ") + std::to_string(i) + " \"" + names[i] + "\"";
  return list.empty() ? "none" : list;
}

/// The names of a file's objects or of its animations.
class NamedParts {
 public:
  explicit NamedParts(std::vector<std::string> names) : names_(std::move(names)) {
    for (std::size_t number = 0; number < names_.size(); ++number)
      ++parts_.try_emplace(names_[number], Part{number, 0}).first->second.count;
  }

  [[nodiscard]] std::span<const std::string> names() const { return names_; }

  /// The number that `choice` picks. `what` is the key it stands under.
  [[nodiscard]] std::size_t pick(const NumberOrName& choice, const std::string& where,
                                 const std::string& what) const {
    if (const auto* number = std::get_if<std::uint32_t>(&choice)) {
      if (*number >= names_.size())
        refuse(where, what, "no number " + std::to_string(*number) + " in the mesh file");
      return *number;
    }
    const auto& name = std::get<std::string>(choice);
    const auto found = parts_.find(name);
    if (found == parts_.end()) refuse(where, what, "no \"" + name + "\" in the mesh file");
    if (found->second.count > 1) refuse(where, what, "several are called \"" + name + "\", pick by number");
    return found->second.number;
  }

 private:
  struct Part {
    std::size_t number;
    std::size_t count;
  };

  [[noreturn]] void refuse(const std::string& where, const std::string& what,
                           const std::string& problem) const {
    throw InputError(where + "." + what + ": " + problem + "; the file has " + list_of(names_));
  }

  std::vector<std::string> names_;
  std::unordered_map<std::string, Part> parts_;
};

/// A mesh file that is loaded, and what is in it by name.
struct KnownFile {
  KnownFile(const std::filesystem::path& path, const ReadOptions& options)
      : file(MeshFile::read(path, options)),
        objects(object_names(file)),
        animations({file.animations().begin(), file.animations().end()}) {}

  static std::vector<std::string> object_names(const MeshFile& file) {
    std::vector<std::string> names;
    for (const LoadedObject& object : file.objects()) names.push_back(object.name);
    return names;
  }

  MeshFile file;
  NamedParts objects;
  NamedParts animations;
};

/// A mesh and the numbers of a placement.
using MovedMeshKey = std::pair<const Mesh*, std::array<double, 16>>;

class Loader {
 public:
  explicit Loader(const SceneDescription& description) : description_(description) {
    for (const ObjectDescription& entry : description.objects)
      if (const std::string& name = entry.settings.name; !name.empty()) names_.reserve(name);
  }

  LoadedScene load() {
    for (std::size_t entry = 0; entry < description_.objects.size(); ++entry) load_entry(entry);
    return std::move(scene_);
  }

 private:
  void load_entry(std::size_t entry);
  void load_object(std::size_t entry, const KnownFile& known, std::size_t index, bool is_only_one);
  const KnownFile& file_of(const std::filesystem::path& path);
  std::string name_of(const ObjectDescription& entry, const LoadedObject& loaded, bool is_only_one);
  [[nodiscard]] Eigen::Matrix3d conversion(const ObjectDescription& entry, const MeshFile& file) const;
  void note_frame(const ObjectDescription& entry, const MeshFile& file);
  [[nodiscard]] std::unique_ptr<PositionSource> open_source(const ObjectDescription& entry,
                                                            const KnownFile& known, std::size_t index) const;
  std::shared_ptr<const Mesh> moved_mesh(const std::shared_ptr<const Mesh>& mesh,
                                         const Eigen::Affine3d& placement);

  [[nodiscard]] ReadOptions options() const { return {.outside_files = description_.outside_files}; }

  const SceneDescription& description_;
  UniqueNames names_;
  std::map<std::filesystem::path, KnownFile> files_;
  std::set<std::string> notes_;
  std::map<MovedMeshKey, std::shared_ptr<const Mesh>> moved_meshes_;
  LoadedScene scene_;
};

const KnownFile& Loader::file_of(const std::filesystem::path& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) return known->second;
  const KnownFile& loaded = files_.try_emplace(path, path, options()).first->second;
  for (const std::string& warning : loaded.file.warnings()) scene_.warnings.push_back(warning);
  return loaded;
}

std::string Loader::name_of(const ObjectDescription& entry, const LoadedObject& loaded, bool is_only_one) {
  if (const std::string& name = entry.settings.name; !name.empty())
    return is_only_one ? name : names_.make(shortened(name, longest_name) + "/" + loaded.name);
  return names_.make(loaded.name.empty() ? entry.mesh.stem().string() : loaded.name);
}

std::unique_ptr<PositionSource> Loader::open_source(const ObjectDescription& entry, const KnownFile& known,
                                                    std::size_t index) const {
  const MeshFile& file = known.file;
  const LoadedObject& object = file.objects()[index];
  if (entry.animation) {
    const std::size_t animation = known.animations.pick(*entry.animation, entry.place, "animation");
    return open_animation(file, index, animation, description_.frames_per_second);
  }
  if (entry.animate_where_possible && object.animated)
    return open_animation(file, index, 0, description_.frames_per_second);
  if (entry.positions.empty()) return nullptr;
  const std::string extension = lower_extension(entry.positions);
  if (extension == ".pc2" || extension == ".mdd") return open_vertex_cache(entry.positions, object);
  if (entry.positions.filename().string().find('#') != std::string::npos)
    return open_sequence(entry.positions, object, index, options());
  if (const auto format = name_of_unread_format(extension))
    throw InputError(entry.place + ".positions: \"" + entry.positions.string() + "\" is " + *format +
                     ", a format that is not read; export a vertex cache (.pc2, .mdd)");
  throw InputError(
      entry.place + ".positions: \"" + entry.positions.string() +
      "\" is neither a vertex cache (.pc2, .mdd) nor a numbered sequence; write a name with #, such as "
      "cloth_####.ply");
}

/// The mesh with its rest positions replaced, the same one for equal placements. Numbers stay. A mirror turns
/// the faces, so that the front stays outside.
std::shared_ptr<const Mesh> Loader::moved_mesh(const std::shared_ptr<const Mesh>& mesh,
                                               const Eigen::Affine3d& placement) {
  if (placement.matrix() == Eigen::Matrix4d::Identity()) return mesh;
  MovedMeshKey key{mesh.get(), {}};
  std::copy_n(placement.matrix().data(), key.second.size(), key.second.begin());
  std::shared_ptr<const Mesh>& moved = moved_meshes_[key];
  if (moved) return moved;
  RawSurface surface;
  for (const Eigen::Vector3d& point : mesh->rest()) surface.positions.push_back(placement * point);
  for (std::uint32_t face = 0; face < mesh->face_count(); ++face) surface.add_face(mesh->face(face));
  if (placement.linear().determinant() < 0) turn_faces(surface);
  return moved = std::make_shared<const Mesh>(
             Mesh::from_polygons(surface.positions, surface.corners, surface.corner_counts));
}

Eigen::Affine3d linear_map(const Eigen::Matrix3d& matrix) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = matrix;
  return map;
}

void Loader::load_object(std::size_t entry_index, const KnownFile& known, std::size_t index,
                         bool is_only_one) {
  const MeshFile& file = known.file;
  const ObjectDescription& entry = description_.objects[entry_index];
  LoadedSceneObject object;
  object.entry = entry_index;
  object.source = open_source(entry, known, index);
  object.settings = entry.settings;
  object.settings.name = name_of(entry, file.objects()[index], is_only_one);
  if (object.source) object.settings.motion = Motion::deformable;
  object.placement = linear_map(entry.transform.stretch) * linear_map(conversion(entry, file));
  if (object.settings.motion == Motion::deformable)
    object.placement = entry.transform.pose() * object.placement;
  try {
    object.mesh = moved_mesh(file.objects()[index].mesh, object.placement);
  } catch (const Error& error) {
    throw InputError(entry.place + ".transform: " + error.what());
  }
  scene_.objects.push_back(std::move(object));
}

/// Takes the file's axes and unit to the scene's, as far as the entry says what they are.
Eigen::Matrix3d Loader::conversion(const ObjectDescription& entry, const MeshFile& file) const {
  const FileFrame& frame = file.frame();
  if (entry.up_is_the_files && !frame.up)
    throw InputError(entry.place + ".up: " + entry.mesh.string() +
                     " does not say which axis points up; write x, y or z");
  if (entry.unit_is_the_files && !frame.metres_per_unit)
    throw InputError(entry.place + ".unit: " + entry.mesh.string() +
                     " does not say what its unit is; write it, such as mm");
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  if (entry.up_is_the_files) map = z_up_from(description_.up).transpose() * frame.to_z_up;
  if (entry.up) map = z_up_from(description_.up).transpose() * z_up_from(*entry.up);
  const auto unit = entry.unit_is_the_files ? frame.metres_per_unit : entry.metres_per_unit;
  return unit ? Eigen::Matrix3d(*unit / description_.metres_per_unit * map) : map;
}

/// Says what was converted, or that a file that says more than "metres, z up" was taken as it stands.
void Loader::note_frame(const ObjectDescription& entry, const MeshFile& file) {
  const Eigen::Matrix3d map = conversion(entry, file);
  const bool has_keys = entry.up || entry.up_is_the_files || entry.metres_per_unit || entry.unit_is_the_files;
  std::string note;
  if (map != Eigen::Matrix3d::Identity())
    note = entry.mesh.string() + ": converted: " + text_of_map(map);
  else if (!has_keys && says_other_than_scene(entry.mesh, file.frame()))
    note = entry.mesh.string() + ": its coordinates are taken as they stand, though it says " +
           text_of_frame(file.frame()) + R"(; "up": "file" and "unit": "file" in a scene file convert them)";
  // Several entries may name one file.
  if (!note.empty() && notes_.insert(note).second) scene_.warnings.push_back(std::move(note));
}

void Loader::load_entry(std::size_t entry_index) {
  const ObjectDescription& entry = description_.objects[entry_index];
  const KnownFile& known = file_of(entry.mesh);
  note_frame(entry, known.file);
  if (entry.node) {
    load_object(entry_index, known, known.objects.pick(*entry.node, entry.place, "node"), true);
    return;
  }
  const auto nodes = known.objects.names();
  if (nodes.size() > 1 && !entry.positions.empty())
    throw InputError(entry.place + ".positions: " + entry.mesh.string() + " holds " +
                     std::to_string(nodes.size()) + " objects; pick one with \"node\": " + list_of(nodes));
  for (std::size_t index = 0; index < nodes.size(); ++index)
    load_object(entry_index, known, index, nodes.size() == 1);
}

}  // namespace

LoadedScene load_scene(const SceneDescription& description) {
  return Loader(description).load();
}

}  // namespace graze::io
