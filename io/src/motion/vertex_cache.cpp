#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <graze/io/motion.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/file_bytes.hpp"
#include "text/opened_files.hpp"

namespace graze::io {
namespace {

constexpr std::string_view pc2_signature("POINTCACHE2\0", 12);
constexpr std::size_t pc2_header_bytes = 32;
constexpr std::size_t mdd_header_bytes = 8;
constexpr std::size_t position_bytes = 3 * sizeof(float);

struct CacheHeader {
  bool is_big_endian = false;
  std::uint32_t vertex_count = 0;
  std::uint32_t frame_count = 0;
  std::uint64_t first_frame = 0;  ///< in bytes
};

CacheHeader read_header(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path, pc2_header_bytes);
  CacheHeader header;
  if (std::string_view(bytes).starts_with(pc2_signature)) {
    if (bytes.size() < pc2_header_bytes) fail(path, "the PC2 header is cut off; write the file again");
    header.vertex_count = word_at(bytes, 16);
    header.frame_count = word_at(bytes, 28);
    header.first_frame = pc2_header_bytes;
    return header;
  }
  if (lower_extension(path) != ".mdd")
    fail(path, "this is no vertex cache; name a PC2 file (it starts with POINTCACHE2) or an .mdd file");
  if (bytes.size() < mdd_header_bytes) fail(path, "the MDD header is cut off; write the file again");
  header.is_big_endian = true;
  header.frame_count = word_at(bytes, 0, true);
  header.vertex_count = word_at(bytes, 4, true);
  header.first_frame = mdd_header_bytes + std::uint64_t{header.frame_count} * sizeof(float);
  return header;
}

/// Both counts are signed in the file.
void check(const std::filesystem::path& path, const CacheHeader& header, std::uint64_t file_bytes,
           std::uint32_t mesh_vertices) {
  constexpr std::uint32_t most = 0x7FFFFFFF;
  if (header.frame_count == 0 || header.frame_count > most)
    fail(path, "header: there is no frame in it; write at least one");
  if (header.vertex_count != mesh_vertices)
    fail(path, joined("header: the cache has ", header.vertex_count, " vertices, the mesh ", mesh_vertices,
                      "; write it for this mesh"));
  const std::uint64_t frame_bytes = std::uint64_t{header.vertex_count} * position_bytes;
  const std::uint64_t there =
      file_bytes < header.first_frame ? 0 : (file_bytes - header.first_frame) / frame_bytes;
  if (there < header.frame_count)
    fail(path, joined("header: ", header.frame_count, " frames are announced and ", there,
                      " are there; write the file again"));
}

class VertexCache : public PositionSource {
 public:
  /// `file_vertices` has the number in the cache of each vertex of the mesh, where a cache of
  /// `file_vertex_count` vertices is of a whole file. It is empty where the mesh is the file.
  VertexCache(const std::filesystem::path& path, std::uint32_t mesh_vertices,
              const std::vector<std::uint32_t>& file_vertices, std::uint32_t file_vertex_count)
      : path_(path), header_(read_header(path)), stream_(open_input(path)) {
    const bool is_of_file = !file_vertices.empty() && header_.vertex_count == file_vertex_count;
    if (is_of_file) vertices_ = file_vertices;
    check(path, header_, std::filesystem::file_size(path), is_of_file ? file_vertex_count : mesh_vertices);
    bytes_.resize(header_.vertex_count * position_bytes);
  }

  [[nodiscard]] std::uint32_t frame_count() const override { return header_.frame_count; }

  void read(std::uint32_t frame, std::vector<Eigen::Vector3d>& positions) override {
    const std::uint32_t number = std::min(frame, header_.frame_count - 1);
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(header_.first_frame + std::uint64_t{number} * bytes_.size()));
    stream_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    if (!stream_) fail(path_, joined("frame ", number, ": reading failed; check the disk"));
    positions.resize(vertices_.empty() ? header_.vertex_count : vertices_.size());
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
      const std::size_t begin = (vertices_.empty() ? vertex : vertices_[vertex]) * position_bytes;
      for (std::size_t axis = 0; axis < 3; ++axis)
        positions[vertex][static_cast<Eigen::Index>(axis)] = static_cast<double>(std::bit_cast<float>(
            word_at({bytes_.data(), bytes_.size()}, begin + axis * sizeof(float), header_.is_big_endian)));
    }
  }

 private:
  std::filesystem::path path_;
  CacheHeader header_;
  std::ifstream stream_;
  std::vector<char> bytes_;
  std::vector<std::uint32_t> vertices_;  ///< those of the cache that the mesh has. Empty means all
};

}  // namespace

std::unique_ptr<PositionSource> open_vertex_cache(const std::filesystem::path& path, const Mesh& mesh) {
  return std::make_unique<VertexCache>(path, mesh.vertex_count(), std::vector<std::uint32_t>(), 0);
}

std::unique_ptr<PositionSource> open_vertex_cache(const std::filesystem::path& path,
                                                  const LoadedObject& object) {
  return std::make_unique<VertexCache>(path, object.mesh->vertex_count(), object.file_vertices,
                                       object.file_vertex_count);
}

}  // namespace graze::io
