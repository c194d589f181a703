#include "core/mesh_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace graze::tests {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T>
T read_value(std::istream& in) {
  T value{};
  std::array<char, sizeof(T)> bytes{};
  if (!in.read(bytes.data(), bytes.size())) throw std::runtime_error("the file ends early");
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::ifstream opened(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + " cannot be read");
  return in;
}

/// The faces of `shape` for which `take` holds, with the vertices that they use.
template <typename Take>
oracle::Shape part_of(const oracle::Shape& shape, const Take& take) {
  oracle::Shape part;
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (std::size_t face = 0; face < shape.faces.size(); ++face) {
    if (!take(face)) continue;
    part.faces.emplace_back();
    for (const std::uint32_t corner : shape.faces[face]) {
      const auto [entry, is_new] =
          numbers.try_emplace(corner, static_cast<std::uint32_t>(part.positions.size()));
      if (is_new) part.positions.push_back(shape.positions[corner]);
      part.faces.back().push_back(entry->second);
    }
  }
  return part;
}

}  // namespace

oracle::Shape read_ply(const std::string& path) {
  std::ifstream in = opened(path);
  std::size_t vertex_count = 0;
  std::size_t face_count = 0;
  std::string header;
  for (std::string line; std::getline(in, line) && line != "end_header"; header += line + "\n") {
    if (line == "property list uchar int vertex_indices") line = "property list uint8 int32 vertex_indices";
    if (line.starts_with("element vertex ")) vertex_count = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) face_count = std::stoul(line.substr(13));
  }
  for (const char* need : {"format binary_little_endian 1.0\n",
                           "property double x\nproperty double y\nproperty double z\nelement face",
                           "property list uint8 int32 vertex_indices\n"})
    if (header.find(need) == std::string::npos) throw std::runtime_error(path + " lacks " + need);
  oracle::Shape shape;
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
    const auto x = read_value<double>(in);
    const auto y = read_value<double>(in);
    shape.positions.emplace_back(x, y, read_value<double>(in));
  }
  for (std::size_t face = 0; face < face_count; ++face) {
    std::vector<std::uint32_t> corners(read_value<std::uint8_t>(in));
    for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(read_value<std::int32_t>(in));
    shape.faces.push_back(corners);
  }
  return shape;
}

std::vector<oracle::Shape> read_obj_objects(const std::string& path) {
  std::ifstream in = opened(path);
  oracle::Shape all;
  std::vector<std::size_t> object_of_face;
  std::size_t objects = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "o") ++objects;
    if (word == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      all.positions.push_back(p);
    }
    if (word != "f") continue;
    all.faces.emplace_back();
    object_of_face.push_back(objects);
    while (words >> word) all.faces.back().push_back(static_cast<std::uint32_t>(std::stoul(word)) - 1);
  }
  std::vector<oracle::Shape> shapes;
  for (std::size_t object = 1; object <= objects; ++object)
    shapes.push_back(part_of(all, [&](std::size_t face) { return object_of_face[face] == object; }));
  return shapes;
}

std::vector<oracle::Shape> pieces_of(const oracle::Shape& shape) {
  std::vector<std::uint32_t> leader(shape.positions.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto leader_of = [&](std::uint32_t vertex) {
    while (leader[vertex] != vertex) vertex = leader[vertex];
    return vertex;
  };
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) leader[leader_of(corner)] = leader_of(face[0]);
  std::vector<std::uint32_t> leaders;
  std::vector<oracle::Shape> pieces;
  for (const auto& face : shape.faces) {
    const std::uint32_t own = leader_of(face[0]);
    if (std::find(leaders.begin(), leaders.end(), own) != leaders.end()) continue;
    leaders.push_back(own);
    pieces.push_back(
        part_of(shape, [&](std::size_t other) { return leader_of(shape.faces[other][0]) == own; }));
  }
  return pieces;
}

}  // namespace graze::tests
