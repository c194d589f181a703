#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/mesh.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

/// A surface as a reader finds it: faces of any number of corners (at least 3), every corner in range.
struct RawSurface {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> corner_counts;

  void add_face(std::span<const std::uint32_t> face) {
    corners.insert(corners.end(), face.begin(), face.end());
    corner_counts.push_back(static_cast<std::uint32_t>(face.size()));
  }
};

/// Turns every face round, its first corner staying first.
void turn_faces(RawSurface& surface);
/// Turns those faces round of whose corners more than half are marked.
void turn_faces(RawSurface& surface, const std::vector<bool>& is_marked);

/// One object as a reader finds it.
struct RawObject {
  std::string name;  ///< may be empty or not unique
  RawSurface surface;
  /// For each vertex its number in the file, as in LoadedObject::file_vertices. It is empty where they are
  /// equal.
  std::vector<std::uint32_t> file_vertices = {};
  std::uint32_t file_vertex_count =
      0;  ///< how many vertices the file has, where `file_vertices` is not empty
};

/// The result of reading a file: its objects, those without a face included, and notes on what was left out.
struct RawFile {
  std::vector<RawObject> objects;
  std::vector<std::string> warnings;
};

/// How many faces were cut, and into how many triangles.
struct CutFaces {
  std::size_t faces = 0;
  std::size_t triangles = 0;
  std::optional<std::size_t> too_complex;  ///< a face that takes too long to cut. The surface is as it was
};

/// Cuts every face of more than four corners into triangles of its own corners, in place.
CutFaces cut_large_faces(RawSurface& surface);

/// The mesh of a surface whose faces have 3 or 4 corners. Throws InputError, naming `path` and `object`, when
/// a face uses a vertex that is not finite. `file_vertices` are as in RawObject.
std::shared_ptr<const Mesh> make_mesh(const std::filesystem::path& path, const std::string& object,
                                      const RawSurface& surface,
                                      std::span<const std::uint32_t> file_vertices = {});

/// Readers of the formats with indexed positions. Throw InputError.
RawFile read_obj(const std::filesystem::path& path);
RawFile read_ply(const std::filesystem::path& path);
RawFile read_off(const std::filesystem::path& path);
/// The number of vertices that the header of a PLY or OFF file announces. Throw InputError.
std::uint64_t announced_ply_vertices(const std::filesystem::path& path);
std::uint64_t announced_off_vertices(const std::filesystem::path& path);

}  // namespace graze::io
