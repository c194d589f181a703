#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/exact/exact.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::oracle {

/// A box in the caller's doubles.
struct Extent {
  Eigen::Vector3d min, max;
};
Extent extent_of(const Shape& shape, std::span<const std::uint32_t> vertices);

/// A limit on distances, and what doubles need to discard pairs soundly.
class Limit {
 public:
  static Limit below(double threshold);                  ///< strictly closer, nothing for 0 or less
  static Limit up_to(const Rational& distance_squared);  ///< as close, or closer
  static Limit none();                                   ///< every distance

  [[nodiscard]] bool admits(const Rational& distance_squared) const;
  /// Whether the boxes are certainly further apart than the limit. Long double squares of doubles neither
  /// overflow nor underflow, and a margin of 1e-4 is far above their rounding.
  [[nodiscard]] bool certainly_excludes(const Extent& a, const Extent& b) const;

 private:
  Rational squared_;
  bool inclusive_ = false;
  bool endless_ = false;
  long double reach_squared_ = 0;
};

/// The square of a lower bound on the distance of two boxes, up to a rounding of 1e-18.
long double gap_squared(const Extent& a, const Extent& b);

/// An edge, or the inner diagonal of a quad (`owner` is then the face).
struct Segment {
  std::array<std::uint32_t, 2> ends{};  ///< an edge's lower vertex first, a diagonal's first corner first
  Feature owner;
  bool fold = false;         ///< a diagonal whose quad is not flat
  bool folded_over = false;  ///< a diagonal whose quad is flat, with both triangles on the same side of it
  Extent extent;

  [[nodiscard]] bool is_edge() const { return owner.kind == FeatureKind::edge; }
};

/// Which side of a triangle (from corner i to i+1) is the inner diagonal of its quad, or `no_side` for none.
struct Triangle {
  static constexpr int no_side = 3;

  std::array<std::uint32_t, 3> corners{};
  int inner_side = no_side;
  Point normal;  ///< by the winding, not of unit length, zero for a degenerate triangle
};

struct Face {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> edges;  ///< distinct
  std::vector<Triangle> triangles;   ///< one or two
  Extent extent;
};

/// A shape in exact coordinates with its edges, diagonals and triangles.
struct ExactShape {
  explicit ExactShape(const Shape& shape);

  std::vector<std::uint32_t> used;    ///< ascending
  std::vector<Point> points;          ///< zero for unused vertices
  std::vector<Extent> point_extents;  ///< a box of one point each
  std::vector<Face> faces;
  std::vector<Segment> segments;  ///< all edges by number, then the inner diagonals by face
  std::size_t edge_count = 0;

  [[nodiscard]] std::span<const Segment> edges() const { return std::span(segments).first(edge_count); }
  /// Whether `part` is `whole`, or a corner or an edge of it.
  [[nodiscard]] bool is_part(Feature part, Feature whole) const;
};

}  // namespace graze::oracle
