#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bench/scenes/world.hpp"

/// Questions to a library that finds contacts of soft bodies, and its answers. They are plain numbers, since
/// the library's module is compiled for other instruction sets than the rest of the program.
namespace graze::bench {

/// A ball and a box stand for rigid bodies of that shape. A box lies along the axes, and both only move in
/// straight lines.
enum class SoftBodyKind { deformable, ball, box };

/// A body, whose memory the finder reads at each call. All lengths are in m. Points and vectors are x, y, z
/// after each other.
struct SoftBodyView {
  SoftBodyKind kind = SoftBodyKind::deformable;
  std::span<const double> positions;
  std::span<const double> velocities;
  std::span<const double> inverse_masses;
  std::vector<Triangle> triangles;
};

struct SoftContactSettings {
  double margin = 0.01;         ///< of each deformable body: two of them meet at the sum
  double voxel = 0.02;          ///< edge of the cells in which distances from rigid bodies are sampled
  double time_step = 1.0 / 60;  ///< from one call to the next, in s
};

/// A vertex of a deformable body beside a face of another one, or beside a rigid body.
struct SoftContact {
  std::uint32_t body = 0;
  std::uint32_t vertex = 0;
  std::uint32_t other = 0;
  bool is_other_rigid = false;
  std::uint32_t face = 0;  ///< of a deformable body
  double weights[3] = {};  ///< of the corners of that face
  double point[3] = {};    ///< on a rigid body
  double normal[3] = {};   ///< from the other body to the vertex
};

/// Finds the contacts of all bodies, but for those of two rigid ones.
class SoftContactFinder {
 public:
  SoftContactFinder() = default;
  virtual ~SoftContactFinder() = default;
  SoftContactFinder(const SoftContactFinder&) = delete;
  SoftContactFinder& operator=(const SoftContactFinder&) = delete;

  /// Replaces contacts by those of the bodies as they are now.
  virtual void find(std::vector<SoftContact>& contacts) = 0;
};

/// The module of peers exports this under the name `graze_bench_soft_contacts`, where Bullet was found.
using MakeSoftContactFinder = void (*)(std::span<const SoftBodyView> bodies,
                                       const SoftContactSettings& settings,
                                       std::unique_ptr<SoftContactFinder>& finder);

}  // namespace graze::bench
