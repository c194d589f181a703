#include <array>
#include <cmath>
#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "bench/scenes/scene_makers.hpp"
#include "bench/scenes/wobbling.hpp"
#include "mean_edge_length.hpp"
#include "scenes/mesh_of.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

/// Vertices that faces connect have one representative.
class Parts {
 public:
  explicit Parts(std::size_t vertices) : above_(vertices) { std::iota(above_.begin(), above_.end(), 0U); }
  std::uint32_t of(std::uint32_t vertex) {
    while (above_[vertex] != vertex) vertex = above_[vertex] = above_[above_[vertex]];
    return vertex;
  }
  void join(std::uint32_t a, std::uint32_t b) { above_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> above_;
};

/// The triangles of one part, its vertices numbered anew.
struct Piece {
  models::MeshData data;
  std::map<std::uint32_t, std::uint32_t> numbers;

  void add(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    for (const std::uint32_t corner : triangle) {
      const auto [place, is_new] = numbers.emplace(corner, static_cast<std::uint32_t>(data.positions.size()));
      if (is_new) data.positions.push_back(mesh.rest()[corner]);
      data.corners.push_back(place->second);
    }
    data.corner_counts.push_back(3);
  }
};

std::vector<std::shared_ptr<const Mesh>> connected_parts(const Mesh& mesh) {
  Parts parts(mesh.vertex_count());
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i)
    for (const std::uint32_t corner : mesh.face(i)) parts.join(mesh.face(i)[0], corner);
  std::map<std::uint32_t, Piece> pieces;
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i) {
    const auto face = mesh.face(i);
    for (std::size_t last = 2; last < face.size(); ++last)
      pieces[parts.of(face[0])].add(mesh, {face[0], face[last - 1], face[last]});
  }
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(pieces.size());
  for (const auto& [vertex, piece] : pieces) meshes.push_back(scenes::mesh_of(piece.data));
  return meshes;
}

/// Waves of about twenty edges in each direction, of half an edge.
Body with_waves(std::shared_ptr<const Mesh> mesh, double edge, scenes::Random& random) {
  const Eigen::Vector3d phase = random.vector(0, 6);
  const double wave = 2 * std::numbers::pi / (20 * edge);
  const auto place = [mesh, edge, phase, wave](std::size_t frame, std::span<float> out) {
    const double time = 0.2 * static_cast<double>(frame);
    std::size_t next = 0;
    for (const Eigen::Vector3d& rest : mesh->rest())
      for (int axis = 0; axis < 3; ++axis)
        out[next++] =
            static_cast<float>(rest[axis] + edge / (2 * std::numbers::sqrt3) *
                                                std::sin(time + phase[axis] + wave * rest[(axis + 1) % 3]));
    return true;
  };
  return {std::move(mesh), place};
}

}  // namespace

BenchScene real_mesh(std::string name, std::string what, const std::string& file) {
  BenchScene scene{std::move(name), std::move(what), 0, 60, {}};
  if (!std::filesystem::exists(file)) {
    scene.missing = "no file " + file;
    return scene;
  }
  std::vector<std::shared_ptr<const Mesh>> meshes;
  const io::MeshFile read = io::MeshFile::read(file);
  for (const io::LoadedObject& object : read.objects())
    for (const auto& part : connected_parts(*object.mesh)) meshes.push_back(part);
  const double edge = tools::mean_edge_length(meshes);
  scene.distance = edge / 2;
  scenes::Random random(7);
  for (const auto& mesh : meshes) scene.bodies.push_back(with_waves(mesh, edge, random));
  return scene;
}

}  // namespace graze::bench
