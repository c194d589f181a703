#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/random.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::oracle {

/// The generator of scenes, with a `below` of its own. So a seed of a test stays the scene that it was. What
/// is made of several numbers asks for each in a statement of its own, or in braces: compilers differ in the
/// order of a call's arguments.
class Random : public scenes::Random {
 public:
  using scenes::Random::Random;

  /// 0 to count - 1, where count > 0.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((next() >> 32U) * count >> 32U);
  }
};

enum class Placement { apart, near, touching, interpenetrating };

/// Two small shapes and a threshold. On a grid all coordinates and the threshold are small multiples of 1/4,
/// which brings exact ties, parallel edges, coplanar and degenerate faces. Otherwise coordinates are generic
/// doubles.
struct RandomScene {
  Shape a, b;
  double threshold = 0;
  Placement placement = Placement::apart;
  bool on_grid = false;
};

/// The scene of a seed. Even seeds are generic, odd ones on a grid. Every four pairs of seeds go through the
/// placements. Shapes have 1 to 12 faces, shared and unused vertices (these may hold NaN), open or closed.
RandomScene random_scene(std::uint64_t seed);

/// How often scenes reached each case, so that a test can assert that none was missed.
struct Coverage {
  std::array<std::size_t, 6> kinds{};          ///< contacts of `features`, by ContactKind
  std::array<std::size_t, 6> closest_kinds{};  ///< contacts of `closest`, by ContactKind
  std::size_t piercings = 0;                   ///< EF contacts where an edge pierces
  std::size_t folds = 0;                       ///< EF and FF contacts on the fold of a quad
  std::size_t degenerate_faces = 0;            ///< triangles of no area
  std::size_t warped_quads = 0;
  std::size_t parallel_edges = 0;  ///< scenes with parallel edges of a and b
  std::size_t zero_distances = 0;  ///< contacts at distance 0 that are no piercing
  std::size_t at_threshold = 0;    ///< scenes whose surfaces are apart by exactly the threshold
  std::size_t without_contact = 0;

  void count(const RandomScene& scene, const std::vector<Named>& features,
             const std::optional<Named>& closest, const Pair& surface);
};

}  // namespace graze::oracle
