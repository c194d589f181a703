#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "bench/scenes/world.hpp"

/// Questions to a library that casts rays, and its answers. They are plain numbers, since the library's
/// module is compiled for other instruction sets than the rest of the program.
namespace graze::bench {

/// A ray without an end.
struct Ray {
  float origin[3];
  float direction[3];
};

struct FirstHit {
  static constexpr std::uint32_t no_object = ~std::uint32_t{0};

  std::uint32_t object = no_object;
  double t = 0;  ///< in lengths of the direction
};

/// Casts rays at a world, which it reads in each update.
class RayCaster {
 public:
  RayCaster() = default;
  virtual ~RayCaster() = default;
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Takes up where everything is now.
  virtual void update() = 0;
  /// Finds the first hit of each ray. Threads may call it at once, each with a number of its own.
  virtual void cast(std::span<const Ray> rays, std::span<FirstHit> hits, unsigned thread) = 0;
};

/// Whether a library builds its tree of all that moves anew in each update, or refits one tree for each
/// object.
enum class RayTree { rebuilt, refitted };

/// The module of peers exports this under the name `graze_bench_rays`, where Embree was found.
using MakeRayCaster = void (*)(const World& world, RayTree tree, unsigned threads,
                               std::unique_ptr<RayCaster>& caster);

}  // namespace graze::bench
