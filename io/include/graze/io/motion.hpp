#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/mesh_file.hpp>
#include <graze/mesh.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

/// @addtogroup io_motion
/// @{

/// Gives the positions of one mesh, frame by frame. One thread at a time may use it. Programs may derive
/// sources of their own.
class GRAZE_API PositionSource {
 public:
  /// Makes a source.
  PositionSource() = default;
  /// Sources are not copied.
  PositionSource(const PositionSource&) = delete;
  /// Sources are not copied.
  PositionSource& operator=(const PositionSource&) = delete;
  /// Frees the source.
  virtual ~PositionSource();

  /// Returns the number of frames, which is at least 1.
  [[nodiscard]] virtual std::uint32_t frame_count() const = 0;
  /// Reads the positions of every vertex at `frame`, counted from 0. Past the end the last frame holds.
  /// Positions are as the file has them, and may be NaN.
  ///
  /// Throws InputError if the file cannot be read, or has another number of vertices than the mesh.
  virtual void read(std::uint32_t frame, std::vector<Eigen::Vector3d>& positions) = 0;
  /// Returns a line for each thing that is odd in the frames read so far. Lines are only added. A sequence
  /// says of the first frame whose faces are not the mesh's, and of the first one that ends within a line.
  [[nodiscard]] virtual std::span<const std::string> warnings() const;
};

/// Opens a numbered sequence of mesh files, such as "liver_####.ply". The run of `#` in the file name stands
/// for a number of at least as many digits. Frame k is the k-th file in the order of the numbers.
///
/// Positions are those of object `object_index` of each file. Throws InputError if no file matches, if two
/// files have the same number, or if a file has another number of vertices than `mesh`. `options` holds for
/// each file.
GRAZE_API std::unique_ptr<PositionSource> open_sequence(const std::filesystem::path& pattern,
                                                        const Mesh& mesh, std::size_t object_index,
                                                        const ReadOptions& options = {});
/// Opens a numbered sequence for an object of a mesh file. A frame may have the vertices of the object, or
/// those of the whole file and no groups (LoadedObject::file_vertices). Everything else is as above.
GRAZE_API std::unique_ptr<PositionSource> open_sequence(const std::filesystem::path& pattern,
                                                        const LoadedObject& object, std::size_t object_index,
                                                        const ReadOptions& options = {});

/// Opens a vertex cache in the format PC2 or MDD. Frame k is its k-th sample. Start time and rate in its
/// header play no part.
///
/// Throws InputError if the file is neither format, is shorter than its header says, or has another number of
/// vertices than `mesh`.
GRAZE_API std::unique_ptr<PositionSource> open_vertex_cache(const std::filesystem::path& path,
                                                            const Mesh& mesh);
/// Opens a vertex cache for an object of a mesh file. The cache may have the vertices of the object, or those
/// of the whole file (LoadedObject::file_vertices). Everything else is as above.
GRAZE_API std::unique_ptr<PositionSource> open_vertex_cache(const std::filesystem::path& path,
                                                            const LoadedObject& object);

/// Plays one of the animations of a mesh file for one of its objects. Frame k is at the time k /
/// frames_per_second, in seconds. Throws Error if an index is out of range, or if the rate is not a positive
/// number.
GRAZE_API std::unique_ptr<PositionSource> open_animation(const MeshFile& file, std::size_t object,
                                                         std::size_t animation, double frames_per_second);

/// @}

}  // namespace graze::io
