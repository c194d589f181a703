#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "response/feature_points.hpp"

namespace graze {

/// A point of a surface, and where it is from there to another point.
struct WalkedPoint {
  Eigen::Vector3d point;
  Eigen::Vector3d gap;     ///< from the point to the other one
  double squared = 0;      ///< the square of the gap
  Feature feature;         ///< the feature with the point inside it
  std::uint32_t face = 0;  ///< a face with the point, where a triangle was asked for it
  std::uint8_t triangle = 0;
  /// The vertices of the simplex with the point inside it: of the vertex, the edge, the fold or the triangle.
  std::array<std::uint32_t, 3> vertices{};
  std::uint8_t vertex_count = 0;

  [[nodiscard]] std::span<const std::uint32_t> corners() const {
    return std::span(vertices).first(vertex_count);
  }
};

/// The point of one feature that is closest to `to`, named by the feature with the point inside it.
WalkedPoint closest_on_feature(const PlacedMesh& placed, const Feature& feature, const Eigen::Vector3d& to);

/// A vertex of a triangle of a face, seen from `to`.
WalkedPoint point_at_corner(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                            std::size_t corner, const Eigen::Vector3d& to);
/// A point inside a side of a triangle of a face, with its gap. The side leads from corner `side` to the
/// next one. A side that is the inner diagonal of a quad has the face as its feature.
WalkedPoint point_on_side(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                          std::size_t side, const Eigen::Vector3d& point, const Eigen::Vector3d& gap);
/// The point of a triangle of a face that is closest to `to`.
WalkedPoint closest_on_triangle_of(const PlacedMesh& placed, std::uint32_t face, std::uint8_t triangle,
                                   const Eigen::Vector3d& to);

/// Finds the nearest point of all triangles that share a vertex with the simplex of `at`. Returns false, and
/// leaves `nearer` as it is, if none is nearer than `at`, up to rounding.
bool find_nearer(const PlacedMesh& placed, const WalkedPoint& at, const Eigen::Vector3d& to,
                 WalkedPoint& nearer);

/// Whether the feature of `at` is an edge that does not join two faces that are wound the same way, or a
/// vertex whose faces do not make one ring.
bool is_at_border(const PlacedMesh& placed, const WalkedPoint& at);

/// A walk over the surface to where it is locally closest to a point.
struct SurfaceWalk {
  WalkedPoint end;
  unsigned steps = 0;        ///< how often the feature changed
  bool has_arrived = false;  ///< whether no triangle that shares a vertex with the end is nearer
  bool met_border = false;   ///< whether a feature after the first one is one of a border
};

/// Walks from a feature to faces around it, as long as one is nearer to `to`. The distance decreases with
/// each step, so that no feature comes twice. The walk gives up after most_steps.
SurfaceWalk walk_to_closest(const PlacedMesh& placed, const Feature& start, const Eigen::Vector3d& to);

/// A walk takes no more steps than this.
inline constexpr unsigned most_steps = 32;

}  // namespace graze
