#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {

using Corners = std::vector<std::uint32_t>;

/// A file of the shared data, or of assimp's test models.
std::filesystem::path shared_file(const std::string& name);
std::filesystem::path assimp_model(const std::string& name);
/// Whether a test must be skipped. Says so once for each file.
bool is_missing(const std::filesystem::path& file);

/// The faces as the mesh has them.
std::vector<Corners> faces_of(const Mesh& mesh);
/// The message with which `MeshFile::read` refuses a file. Empty when it reads it. Fails the test for any
/// exception that is no InputError, and for a message of several lines or without the file's name.
std::string refusal_of(const std::filesystem::path& file);
/// The largest distance between two positions of one number.
double largest_difference(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b);

/// A number's bytes appended, the lowest first or last.
template <typename Number>
void append(std::string& bytes, Number number, bool is_big_endian = false) {
  std::string raw(reinterpret_cast<const char*>(&number), sizeof number);
  if (is_big_endian) raw.assign(raw.rbegin(), raw.rend());
  bytes += raw;
}

std::string base64(std::string_view bytes);

/// A closed box of 6 quads, 8 vertices, wound outward.
struct Box {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Corners> quads;
};
Box make_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// While there is one, what is lost is not reported: assimp (5.2) loses memory of its own where it gives up
/// on a damaged file, and the channels of morph targets.
class AssimpLeaks {
 public:
  AssimpLeaks();
  ~AssimpLeaks();
  AssimpLeaks(const AssimpLeaks&) = delete;
  AssimpLeaks& operator=(const AssimpLeaks&) = delete;
};

}  // namespace graze::tests
