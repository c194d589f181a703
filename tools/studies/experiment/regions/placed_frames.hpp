#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/mesh.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench/scenes/scenes.hpp"
#include "experiment/regions/near_vertices.hpp"

namespace graze::tools {

/// Some frames of a scene, with the truth about them.
struct PlacedFrames {
  /// Vertices of two objects that are nearer than the scene's distance.
  struct NearPair {
    std::uint32_t object_a, object_b;  ///< a < b
    NearVertexPair vertices;
  };
  struct Frame {
    std::vector<std::vector<Eigen::Vector3d>> positions;  ///< of each object
    std::vector<NearPair> near_pairs;
  };

  std::string name, what;
  double distance = 0;
  std::vector<std::shared_ptr<const Mesh>> meshes;  ///< of each object
  std::vector<Frame> frames;

  [[nodiscard]] std::size_t vertex_count() const;
  /// The number of near pairs in all frames together.
  [[nodiscard]] std::uint64_t near_pair_count() const;
};

/// `count` frames of a scene, or all if there are fewer, evenly from the first to the last.
PlacedFrames place_frames(const bench::BenchScene& scene, std::size_t count);

}  // namespace graze::tools
