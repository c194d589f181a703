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

/// One object of a mesh file.
struct LoadedObject {
  std::string name;  ///< unique within its file
  std::shared_ptr<const Mesh> mesh;
  bool animated =
      false;  ///< an animation of the file moves it: by its skeleton, its morph targets or its node
};

/// The axes and the unit that a file says its coordinates have. graze takes coordinates as they stand in
/// every format; the keys `up` and `unit` of a scene file convert them.
struct FileFrame {
  std::optional<double> metres_per_unit;  ///< the length of 1 in the file; none: the file does not say
  std::optional<std::string> up;  ///< the axis that points up: `x`, `y`, `z`, or `-x`, …; none: not said
  /// Takes the file's axes to those in which x points right and z up. The identity where nothing is said.
  Eigen::Matrix3d to_z_up = Eigen::Matrix3d::Identity();
};

/// The objects and animations of a mesh file. A copy shares the data. Every const member may be called from
/// any number of threads at once.
///
/// OBJ, PLY and OFF keep the file's own vertex numbers, unused vertices included, in double precision. An OBJ
/// group is one object with the whole file's vertices. graze reads glTF 2 and STL itself;
/// assimp reads every other format, in single precision. In these formats each node with faces is an object.
/// Its vertices are where the node and the skeleton put them while nothing plays. Vertices repeated for seams
/// are one again, in order of first appearance, where position, skin weights and morph offsets are equal. A
/// mirrored node or joint turns the faces, so that the front stays outside. Triangles and quads stay as they
/// are; a face of more corners is cut into triangles. Coordinates are those of the file: no unit or axis is
/// converted.
class GRAZE_API MeshFile {
 public:
  /// Reads the file. Throws InputError when it is missing, damaged, in a format that is not read, has no
  /// face, or a face uses a vertex that does not exist or is not finite.
  static MeshFile read(const std::filesystem::path& path);

  /// At least one.
  [[nodiscard]] std::span<const LoadedObject> objects() const;
  /// The animations' names in file order; a name may be empty.
  [[nodiscard]] std::span<const std::string> animations() const;
  /// A line for each thing that was left out or changed.
  [[nodiscard]] std::span<const std::string> warnings() const;

  /// The axes and the unit that the file says its coordinates have.
  [[nodiscard]] const FileFrame& frame() const;

  /// How long an animation lasts. Throws Error when `animation` is out of range.
  [[nodiscard]] double animation_seconds(std::size_t animation) const;
  /// Gives the positions of an object's vertices at `seconds` of an animation, clamped to its length. Node
  /// and bone keys are interpolated linearly (rotations along the shorter arc); glTF steps and cubic splines
  /// are kept. `positions` becomes vertex_count long. Throws Error when a number is out of range.
  void animate(std::size_t object, std::size_t animation, double seconds,
               std::vector<Eigen::Vector3d>& positions) const;

 private:
  struct Content;
  explicit MeshFile(std::shared_ptr<const Content> content);

  std::shared_ptr<const Content> content_;
};

}  // namespace graze::io
