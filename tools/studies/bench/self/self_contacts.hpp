#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bench/scenes/world.hpp"

/// Questions to a library that finds where a surface is near itself, and its answers. They are plain numbers,
/// since the library's module is compiled for other instruction sets than the rest of the program.
namespace graze::bench {

/// A surface, whose memory the finder reads at each call. x, y, z of each vertex, in m.
struct SelfSurface {
  std::span<const double> positions;
  std::span<const Triangle> triangles;
};

class SelfContactFinder {
 public:
  SelfContactFinder() = default;
  virtual ~SelfContactFinder() = default;
  SelfContactFinder(const SelfContactFinder&) = delete;
  SelfContactFinder& operator=(const SelfContactFinder&) = delete;

  /// Finds what is near where the surface is now. This is what is timed.
  virtual void find() = 0;
  /// How many contacts the last `find` has listed.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Replaces `vertices` by the vertices of these contacts, in any order and as often as they are listed.
  virtual void list_vertices(std::vector<std::uint32_t>& vertices) const = 0;
};

/// The module of peers exports this under the name `graze_bench_self_contacts`, where Bullet was found.
using MakeSelfContactFinder = void (*)(const SelfSurface& surface, double distance,
                                       std::unique_ptr<SelfContactFinder>& finder);

}  // namespace graze::bench
