#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

/// @addtogroup io_meshes
/// @{

/// One object of a mesh file.
struct LoadedObject {
  /// A name that no other object of the file has.
  std::string name;
  /// The faces and the rest positions of the object.
  std::shared_ptr<const Mesh> mesh;
  /// True if an animation of the file moves the object: by its skeleton, its morph targets or its node.
  bool animated = false;
  /// The number in the file of each vertex of the mesh, ascending and counted from 0. It is empty if the mesh
  /// has the file's own numbers, and in formats whose vertices are welded. Only an OBJ file of several groups
  /// has it.
  std::vector<std::uint32_t> file_vertices = {};
  /// How many vertices the file has. It is 0 if #file_vertices is empty.
  std::uint32_t file_vertex_count = 0;
};

/// The axes and the unit that a file says its coordinates have. graze takes the coordinates of every format
/// as they stand. The keys `up` and `unit` of a scene file convert them.
struct FileFrame {
  /// The length of 1 in the file, in metres. No value means that the file does not say.
  std::optional<double> metres_per_unit;
  /// The axis that points up: `x`, `y` or `z`, with a minus sign for the opposite direction. No value means
  /// that the file does not say.
  std::optional<std::string> up;
  /// The rotation from the file's axes to axes in which x points right and z points up. It is the identity if
  /// the file does not say.
  Eigen::Matrix3d to_z_up = Eigen::Matrix3d::Identity();
};

/// Says what a reader of mesh files may do.
struct ReadOptions {
  /// True lets a mesh file name files outside its own folder, such as a buffer of glTF. Folders below its own
  /// are always allowed. A file from a stranger should not have this, since it could name any file.
  bool outside_files = false;
};

/// The objects and animations of a mesh file. A copy shares the data. Any number of threads may call const
/// members at the same time. docs/formats.md has a table of all formats.
///
/// @par OBJ, PLY and OFF
/// They keep the file's own vertex numbers, unused vertices included, in double precision. Of an OBJ file of
/// several groups, each group is an object. It has the vertices that its faces use, in the order of the file,
/// and LoadedObject::file_vertices has their numbers in the file.
///
/// @par Other formats
/// graze reads glTF 2 and STL itself. assimp reads every other format, in single precision. In glTF 2 and in
/// what assimp reads, each node with faces is an object. Its vertices are where the node and the skeleton put
/// them while nothing plays. In all these formats, vertices that are repeated for seams become one. They keep
/// the order of first appearance. Two vertices become one if position, skin weights and morph offsets are
/// equal. A mirrored node or joint turns the faces, so that the front stays outside.
///
/// @par All formats
/// Triangles and quads stay as they are. A face of more corners is cut into triangles. Coordinates are those
/// of the file: no unit or axis is converted.
class GRAZE_API MeshFile {
 public:
  /// Reads a file. Throws InputError if it is missing or damaged, if its format is not read, or if it has no
  /// face. Also throws InputError if a face uses a vertex that does not exist or is not finite, or if the
  /// file names a file that `options` does not allow. So it does where the file unfolds to far more than its
  /// size, and where there is not enough memory for it.
  static MeshFile read(const std::filesystem::path& path, const ReadOptions& options = {});

  /// Returns the objects of the file, of which there is at least one.
  [[nodiscard]] std::span<const LoadedObject> objects() const;
  /// Returns the names of the animations, in the order of the file. A name may be empty.
  [[nodiscard]] std::span<const std::string> animations() const;
  /// Returns a line for each thing that reading left out or changed.
  [[nodiscard]] std::span<const std::string> warnings() const;

  /// Returns the axes and the unit that the file says its coordinates have.
  [[nodiscard]] const FileFrame& frame() const;

  /// Returns how long an animation lasts, in seconds. Throws Error if `animation` is out of range.
  [[nodiscard]] double animation_seconds(std::size_t animation) const;
  /// Computes the positions of an object's vertices at a time of an animation. `positions` gets one for each
  /// vertex of the mesh. An object that the animation does not move stays at rest.
  ///
  /// `seconds` is clamped to the length of the animation. Keys of nodes and bones are interpolated linearly,
  /// and rotations along the shorter arc. Steps and cubic splines of glTF are kept. Throws Error if an index
  /// is out of range.
  void animate(std::size_t object, std::size_t animation, double seconds,
               std::vector<Eigen::Vector3d>& positions) const;

 private:
  struct Content;
  explicit MeshFile(std::shared_ptr<const Content> content);

  std::shared_ptr<const Content> content_;
};

/// @}

}  // namespace graze::io
