#pragma once

#include <memory>
#include <span>
#include <string>

#include "bench/contender.hpp"
#include "bench/scenes.hpp"

namespace graze::bench {

/// What is true in a frame, made without graze: task A by the row grid over all vertices, B and D by the
/// exact distances of all pairs of triangles with near boxes.
class Verification {
 public:
  Verification(const BenchScene& scene, Task task, std::unique_ptr<Contender> oracle);

  /// Makes the truth of the world's present frame.
  void update();
  /// What is wrong with an answer for this frame, in one sentence; empty where nothing is. `precision` is how
  /// closely distances must agree beyond what double itself loses.
  [[nodiscard]] std::string complaint(Found& found, double precision) const;
  /// Of tasks B and D the near pairs of triangles of that frame, those of two objects side by side.
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
