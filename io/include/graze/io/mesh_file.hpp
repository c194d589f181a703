#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <memory>
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

/// What a mesh file holds: its objects and their animations. A copy shares the data; every const member may
/// be called from any number of threads at once.
///
/// OBJ, PLY and OFF keep the file's own vertex numbers, unused vertices included, and full double precision;
/// an OBJ group is one object with the whole file's vertices. Every other format is read by assimp, in single
/// precision: one object for each node with faces, its vertices where the node and skeleton put them while
/// nothing plays, vertices repeated for seams welded in order of first appearance (equal position, skin
/// weights and morph offsets). Triangles and quads stay as they are; a face of more corners is cut into
/// triangles.
class GRAZE_API MeshFile {
 public:
  /// Reads the file. Throws InputError when it is missing, damaged, has no face, or a face uses a vertex that
  /// does not exist or is not finite.
  static MeshFile read(const std::filesystem::path& path);

  /// At least one.
  [[nodiscard]] std::span<const LoadedObject> objects() const;
  /// The animations' names in file order; a name may be empty.
  [[nodiscard]] std::span<const std::string> animations() const;
  /// What was left out or changed, one line each.
  [[nodiscard]] std::span<const std::string> warnings() const;

  /// How long an animation lasts. Throws Error when `animation` is out of range.
  [[nodiscard]] double animation_seconds(std::size_t animation) const;
  /// Where the vertices of an object's mesh are at `seconds` of an animation, clamped to its length. Node and
  /// bone keys are interpolated linearly (rotations along the shorter arc), glTF steps are kept. `positions`
  /// becomes vertex_count long. Throws Error when a number is out of range.
  void animate(std::size_t object, std::size_t animation, double seconds,
               std::vector<Eigen::Vector3d>& positions) const;

 private:
  struct Content;
  explicit MeshFile(std::shared_ptr<const Content> content);

  std::shared_ptr<const Content> content_;
};

}  // namespace graze::io
