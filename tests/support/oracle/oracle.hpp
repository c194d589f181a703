#pragma once

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <graze/contact.hpp>
#include <optional>
#include <utility>
#include <vector>

/// Brute force over every pair of features, decided in exact rational arithmetic. Shares nothing with the
/// library but the names of its enumerations. A test compares the library's sets and values with these.
/// Doubles discard only what is certainly too far. Every function is a pure function of its arguments.
namespace graze::oracle {

/// A surface as plain arrays. A vertex that no face uses is never read and may hold anything.
struct Shape {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::vector<std::uint32_t>> faces;  ///< 3 or 4 corners each
};

/// Each edge's two vertices, lower first, numbered in the order of first appearance along the faces' corners.
std::vector<std::array<std::uint32_t, 2>> edges_of(const Shape& shape);

/// Which features of a shape are looked at against other features of it.
struct SelfRule {
  std::function<bool(const Feature&, const Feature&)> may;
  std::function<bool(const Feature&, const Feature&)> may_pierce;  ///< an edge or fold and a face
};

/// Which faces of two shapes are looked at against each other. Other features are looked at if some face of
/// the one and some face of the other are. For a shape and itself a rule says it of each two features.
class FacePairs {
 public:
  /// All faces are looked at.
  FacePairs() = default;
  FacePairs(const Shape& a, const Shape& b,
            const std::function<bool(std::uint32_t, std::uint32_t)>& are_looked_at);

  explicit FacePairs(SelfRule rule) : self_(std::move(rule)) {}

  [[nodiscard]] bool is_of_self() const { return self_.may != nullptr; }
  [[nodiscard]] bool may(const Feature& a, const Feature& b) const;
  /// Whether it counts that an edge or fold pierces a face.
  [[nodiscard]] bool may_pierce(const Feature& a, const Feature& b) const {
    return is_of_self() ? self_.may_pierce(a, b) : may(a, b);
  }
  /// Whether a face beside an edge counts where two edges may be locally closest.
  [[nodiscard]] bool may_lead(const Feature& a, const Feature& b) const { return is_of_self() || may(a, b); }
  [[nodiscard]] bool may_vertices(std::uint32_t a, std::uint32_t b) const {
    return may({FeatureKind::vertex, a}, {FeatureKind::vertex, b});
  }
  /// Whether any faces are looked at.
  [[nodiscard]] bool are_some() const;

 private:
  std::array<std::vector<std::vector<std::uint32_t>>, 3> a_;  ///< by kind and index: the faces of a feature
  std::array<std::vector<std::vector<std::uint32_t>>, 3> b_;
  std::vector<std::vector<bool>> looked_at_;  ///< by face and face, empty if all are
  SelfRule self_;                             ///< empty for two shapes
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
  bool sunk = false;     ///< two edges that lie behind each other, of which one pierces a face
};

/// The contacts of detail `features`, sorted by (kind, a, b), each once. Where an FF contact of distance 0
/// has several crossings its points are those of a's fold, else of b's fold, nearest the fold's first corner.
std::vector<Named> features(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs = {});

/// The contacts of detail `nearest` between surfaces that are no solids, sorted by (kind, a, b), each once:
///
/// - For each used vertex strictly nearer to the other surface than `threshold`, its closest point there. If
///   several features hold that point, or several points are equally close, the lowest feature names it.
/// - Each pair of edges whose closest points are inside both, strictly nearer than `threshold`, if no face at
///   one of them leads nearer and none lies flat, or if the pair bounds a patch (oracle_edges.hpp). The
///   diagonal of a quad is no edge. The shapes at rest decide which edges are creases.
/// - Each face that an edge pierces, at any threshold.
/// - If there is none of these, the nearest EF or FF of `features`, which is at the fold of a quad. Exact
/// ties
///   go to the lowest (kind, a, b).
std::vector<Named> nearest(const Shape& a, const Shape& b, double threshold, const Shape& rest_a,
                           const Shape& rest_b);
/// Returns the contacts of shapes that are at rest.
inline std::vector<Named> nearest(const Shape& a, const Shape& b, double threshold) {
  return nearest(a, b, threshold, a, b);
}

/// Every pair of used vertices closer than `threshold`, sorted.
std::vector<Named> vertices(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs = {});

/// For each pair of leaf regions of the rest shapes the closest vertex pair at the present positions (ties
/// lowest a, then b), where it is closer than `threshold`. They are sorted. Faces are those of `a` and `b`.
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

/// The one contact of detail `closest`. None unless the surfaces are closer than `threshold` or pierced.
std::optional<Named> closest(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs = {});

/// Where a point lies with regard to a closed surface. The number is 1 inside a surface whose normals point
/// outside.
struct Winding {
  int number = 0;  ///< 0 for a point on the surface
  bool on_surface = false;

  [[nodiscard]] bool is_inside() const { return number != 0; }
};
Winding winding(const Shape& closed, const Eigen::Vector3d& point);

/// Which of the two objects of a pair are solids: closed surfaces that bound a volume.
struct Solids {
  bool a = false;
  bool b = false;
};

/// How two objects of which at least one is a solid lie in each other. The first line that holds counts:
///
/// - An edge of one pierces a face of the other: `crossing`.
/// - All used vertices of a are inside the solid b: `a_in_b`.
/// - All used vertices of b are inside the solid a: `b_in_a`.
/// - A vertex of one is inside the other: `crossing`.
///
/// A point on the surface is not inside. Two surfaces that are no solids are `none`. The two lines in the
/// middle never hold both: the outermost vertex of both shapes is in no solid.
enum class Containment : std::uint8_t { none, a_in_b, b_in_a, crossing };

/// The sides of a contact that solids decide: that of a solid on which the contact's vertex lies. None where
/// the contact has no such vertex, or the object is no solid.
struct SolidSides {
  std::optional<Side> a;  ///< of a's surface, where b's vertex is
  std::optional<Side> b;  ///< of b's surface, where a's vertex is
};

/// The answer to detail `nearest` about two objects that may be solids.
struct SolidPair {
  Containment inside = Containment::none;
  bool has_vertex_inside = false;
  /// As `nearest`, and the closest point of each used vertex inside the other's solid, however far.
  std::vector<Named> contacts;
  std::vector<SolidSides> sides;  ///< of each contact
};
SolidPair solid_pair(const Shape& a, const Shape& b, Solids solids, double threshold, const Shape& rest_a,
                     const Shape& rest_b);
/// Returns the answer about shapes that are at rest.
inline SolidPair solid_pair(const Shape& a, const Shape& b, Solids solids, double threshold) {
  return solid_pair(a, b, solids, threshold, a, b);
}

/// Which lies in which where only some faces are looked at against each other. These decide what pierces. All
/// faces of a solid decide what is inside of it.
Containment containment(const Shape& a, const Shape& b, Solids solids, const FacePairs& pairs);

/// One region of the octree of a rest shape.
struct OracleRegion {
  std::uint32_t level = 0;
  bool leaf = true;
  std::uint32_t middle = 0;             ///< eq. 1, ties to the lowest index
  std::vector<std::uint32_t> vertices;  ///< ascending
};

/// All regions, sorted by (level, vertices). A vertex's offset from the root box's minimum and the root box's
/// extent are double differences. The halving from there on is exact.
std::vector<OracleRegion> regions_of(const Shape& rest);

/// Eq. 2: the largest distance of a vertex of `region` from its middle vertex, rounded to nearest.
double radius(const OracleRegion& region, const std::vector<Eigen::Vector3d>& positions);

/// Eq. 3: for each level the largest radius of its regions.
std::vector<double> level_radii(const std::vector<OracleRegion>& tree,
                                const std::vector<Eigen::Vector3d>& positions);

}  // namespace graze::oracle
