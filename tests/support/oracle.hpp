#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <graze/contact.hpp>
#include <optional>
#include <vector>

/// Brute force over every pair of features, decided in exact rational arithmetic. Shares nothing with the
/// library but the names of its enumerations; a test compares the library's sets and values with these.
/// Doubles discard only what is certainly too far. Every function is a pure function of its arguments.
namespace graze::oracle {

/// A surface as plain arrays. A vertex that no face uses is never read and may hold anything.
struct Shape {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::vector<std::uint32_t>> faces;  ///< 3 or 4 corners each
};

/// Each edge's two vertices, lower first, numbered in the order of first appearance along the faces' corners.
std::vector<std::array<std::uint32_t, 2>> edges_of(const Shape& shape);

/// Which faces of two shapes are looked at against each other. Other features are looked at if some face of
/// the one and some face of the other are.
class FacePairs {
 public:
  /// All faces are looked at.
  FacePairs() = default;
  FacePairs(const Shape& a, const Shape& b,
            const std::function<bool(std::uint32_t, std::uint32_t)>& are_looked_at);

  [[nodiscard]] bool may(const Feature& a, const Feature& b) const;
  [[nodiscard]] bool may_vertices(std::uint32_t a, std::uint32_t b) const {
    return may({FeatureKind::vertex, a}, {FeatureKind::vertex, b});
  }
  /// Whether any faces are looked at.
  [[nodiscard]] bool are_some() const;

 private:
  std::array<std::vector<std::vector<std::uint32_t>>, 3> a_;  ///< by kind and index: the faces of a feature
  std::array<std::vector<std::vector<std::uint32_t>>, 3> b_;
  std::vector<std::vector<bool>> looked_at_;  ///< by face and face; empty if all are
};

/// One contact. Distance and points are the exact ones rounded to nearest.
struct Named {
  ContactKind kind = ContactKind::VV;
  Feature a, b;
  double distance = 0;
  mpq_class distance_squared;  ///< exact
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  bool pierced = false;  ///< an edge passes through a face: a contact at every threshold
};

/// The contacts of detail `features`, sorted by (kind, a, b), each once. Where an FF contact of distance 0
/// has several crossings its points are those of a's fold, else of b's fold, nearest the fold's first corner.
std::vector<Named> features(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs = {});

/// Every pair of used vertices closer than `threshold`, sorted.
std::vector<Named> vertices(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs = {});

/// For each pair of leaf regions of the rest shapes the closest vertex pair at the present positions (ties
/// lowest a, then b), where it is closer than `threshold`; sorted. Faces are those of `a` and `b`.
std::vector<Named> regions(const Shape& a, const Shape& b, double threshold, const Shape& rest_a,
                           const Shape& rest_b, const FacePairs& pairs = {});

/// How far two shapes are apart.
struct Pair {
  mpq_class distance_squared;  ///< exact
  double distance_down = 0;    ///< the distance rounded down and up: equal when a double holds it
  double distance_up = 0;
  bool pierced = false;  ///< an edge of one passes through a face of the other
};
Pair surface_distance(const Shape& a, const Shape& b, const FacePairs& pairs = {});
Pair vertex_distance(const Shape& a, const Shape& b, const FacePairs& pairs = {});

/// The one contact of detail `closest`; none unless the surfaces are closer than `threshold` or pierced.
std::optional<Named> closest(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs = {});

/// One region of the octree of a rest shape.
struct OracleRegion {
  std::uint32_t level = 0;
  bool leaf = true;
  std::uint32_t middle = 0;             ///< eq. 1, ties to the lowest index
  std::vector<std::uint32_t> vertices;  ///< ascending
};

/// All regions, sorted by (level, vertices). A vertex's offset from the root box's minimum and the root box's
/// extent are double differences; the halving from there on is exact.
std::vector<OracleRegion> regions_of(const Shape& rest);

/// Eq. 2: the largest distance of a vertex of `region` from its middle vertex, rounded to nearest.
double radius(const OracleRegion& region, const std::vector<Eigen::Vector3d>& positions);

/// Eq. 3: for each level the largest radius of its regions.
std::vector<double> level_radii(const std::vector<OracleRegion>& tree,
                                const std::vector<Eigen::Vector3d>& positions);

}  // namespace graze::oracle
