#pragma once

#include <memory>
#include <span>
#include <string>

#include "bench/contender.hpp"
#include "bench/scenes/scenes.hpp"

namespace graze::bench {

/// The true answer for a frame, computed without graze. Task A uses the row grid over all vertices. Tasks B
/// and D use the exact distances of all pairs of triangles with near boxes.
class Verification {
 public:
  Verification(const BenchScene& scene, Task task, std::unique_ptr<Contender> oracle);

  /// Makes the truth of the world's present frame.
  void update();
  /// Describes an error of an answer for this frame in one sentence. Empty if there is none. `precision` is
  /// how closely distances must agree, beyond the rounding error of double itself.
  [[nodiscard]] std::string complaint(Found& found, double precision) const;
  /// The near pairs of triangles of the frame, for tasks B and D. The pairs of two objects stand side by
  /// side.
  [[nodiscard]] std::span<const TrianglePair> triangle_pairs() const { return truth_.triangle_pairs; }

 private:
  [[nodiscard]] std::string about_vertices(Found& found) const;
  [[nodiscard]] std::string about_triangles(Found& found, double precision) const;
  [[nodiscard]] std::string about_features(const Found& found) const;
  [[nodiscard]] std::string about_distances(Found& found, double precision) const;
  [[nodiscard]] std::vector<ObjectDistance> least_distances() const;

  const BenchScene& scene_;
  Task task_;
  std::unique_ptr<Contender> oracle_;
  Found truth_;  ///< sorted
};

}  // namespace graze::bench
