#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/mesh_file.hpp>
#include <graze/mesh.hpp>
#include <memory>
#include <vector>

namespace graze::io {

/// Positions of one mesh, frame by frame. One thread at a time.
class GRAZE_API PositionSource {
 public:
  PositionSource() = default;
  PositionSource(const PositionSource&) = delete;
  PositionSource& operator=(const PositionSource&) = delete;
  virtual ~PositionSource();

  /// At least 1.
  [[nodiscard]] virtual std::uint32_t frame_count() const = 0;
  /// Positions of every vertex at `frame`; past the end the last frame holds. They are as the file has them,
  /// NaN included. Throws InputError when the file cannot be read or has another number of vertices than the
  /// mesh.
  virtual void read(std::uint32_t frame, std::vector<Eigen::Vector3d>& positions) = 0;
};

/// A numbered sequence of mesh files such as "liver_####.ply": the run of # in the file name stands for a
/// number of at least as many digits. Frame k is the k-th file by number, and of it the object
/// `object_index`. Throws InputError when nothing matches, when two files have one number, or when a count
/// differs.
GRAZE_API std::unique_ptr<PositionSource> open_sequence(const std::filesystem::path& pattern,
                                                        const Mesh& mesh, std::size_t object_index);

/// A PC2 or MDD vertex cache; frame k is its k-th sample, whatever its start time and rate. Throws InputError
/// when the file is neither, is shorter than its header says, or is for another number of vertices.
GRAZE_API std::unique_ptr<PositionSource> open_vertex_cache(const std::filesystem::path& path,
                                                            const Mesh& mesh);

/// An object of a mesh file under one of its animations; frame k is at k / frames_per_second. Throws Error
/// when a number is out of range or the rate is not a positive number.
GRAZE_API std::unique_ptr<PositionSource> open_animation(const MeshFile& file, std::size_t object,
                                                         std::size_t animation, double frames_per_second);

}  // namespace graze::io
