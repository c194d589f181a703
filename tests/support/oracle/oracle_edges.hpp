#pragma once

#include <cstdint>
#include <vector>

#include "support/exact/exact_distance.hpp"

namespace graze::oracle {

/// A triangle that has an edge, of a face that has it, and the corner that is not an end of the edge.
struct Beside {
  std::uint32_t face;
  std::uint32_t corner;
  const Triangle* triangle;
};

/// The triangles beside each edge of a shape. Faces that repeat vertices may have none beside an edge, or
/// two.
class EdgeSurroundings {
 public:
  explicit EdgeSurroundings(const ExactShape& shape);

  [[nodiscard]] const std::vector<Beside>& beside(std::uint32_t edge) const { return beside_[edge]; }
  /// The faces that have an edge, each once.
  [[nodiscard]] const std::vector<std::uint32_t>& faces(std::uint32_t edge) const { return faces_[edge]; }

 private:
  std::vector<std::vector<Beside>> beside_;
  std::vector<std::vector<std::uint32_t>> faces_;
};

/// Finds the creases of a shape at rest, by edge. An edge is one if it has not exactly two faces, or if the
/// normals n and m of its two triangles have n·m < 0 or (n·m)² < (127/128) n² m². Of a quad it is the
/// triangle that has the edge that counts. A triangle of no area has the normal 0.
std::vector<bool> creases_of(const Shape& rest);

/// Which edges of two surfaces are creases.
struct Creases {
  Creases(const Shape& rest_a, const Shape& rest_b) : a(creases_of(rest_a)), b(creases_of(rest_b)) {}

  std::vector<bool> a, b;
};

/// A pair of edges whose closest points are unique and inside both, and what detail `nearest` says of it.
struct EdgePair {
  Feature a, b;
  SegmentContact contact;
  /// The sides by the normals of the triangles beside the edge of a, and of b. They are `none` where the
  /// edges cross, and where the sum of the normals is square to the direction to within 2^-36 / π.
  Side side_a = Side::none;
  Side side_b = Side::none;
  /// Both sides are `back`, and one of the edges pierces a face of the other shape.
  bool is_sunk = false;
  /// On no triangle beside either edge does a way square to the edge lead nearer to the other one.
  bool is_locally_closest = false;
  /// One of the edges is no crease, and its triangles lie on both sides of it, square to the direction. All
  /// of them have an area and are looked at.
  bool lies_flat = false;
  /// Both are creases. The direction from a to b, or its opposite if the pair is sunk, is within 10.2° of the
  /// normal cone of the edge of a, and the opposite of that is as near to the cone of the edge of b.
  bool bounds_patch = false;

  [[nodiscard]] bool is_listed() const { return (is_locally_closest && !lies_flat) || bounds_patch; }
};

/// Judges pairs of edges of two shapes. The shapes and the face pairs have to outlive it.
class EdgeOracle {
 public:
  EdgeOracle(const ExactShape& a, const ExactShape& b, const FacePairs& pairs = {});

  /// All pairs of edges within the limit that may be looked at, by edge a, then by edge b.
  [[nodiscard]] std::vector<EdgePair> pairs_within(const Limit& limit, const Creases& creases) const;
  /// Whether two edges with unique closest points inside both are sunk.
  [[nodiscard]] bool are_sunk(const Feature& edge_a, const Feature& edge_b) const;

 private:
  /// One of the two shapes.
  struct Surface {
    explicit Surface(const ExactShape& exact) : shape(exact), around(exact) {}

    const ExactShape& shape;
    EdgeSurroundings around;
    std::vector<bool> pierces;  ///< whether an edge pierces a face of the other shape
  };

  [[nodiscard]] EdgePair judged(const Segment& edge_a, const Segment& edge_b, SegmentContact contact,
                                const Creases& creases) const;

  Surface a_;
  Surface b_;
  const FacePairs& pairs_;
};

}  // namespace graze::oracle
