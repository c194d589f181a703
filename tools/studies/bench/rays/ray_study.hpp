#pragma once

#include <cstddef>

#include "bench/peer_module.hpp"
#include "bench/rays/ray_caster.hpp"
#include "bench/scenes/scenes.hpp"
#include "figures/result_table.hpp"

namespace graze::bench {

/// Casts rays at a scene with graze and with Embree, frame by frame in turn.
class RayStudy {
 public:
  RayStudy();

  /// Adds a row for each library with so many threads. `frames` are 0 for the scene's own number. Where the
  /// module lacks Embree, there is graze's row alone.
  void add(const PeerModule& module, const BenchScene& scene, std::size_t frames, unsigned threads);
  [[nodiscard]] const tools::ResultTable& table() const { return table_; }

 private:
  tools::ResultTable table_;
};

}  // namespace graze::bench
