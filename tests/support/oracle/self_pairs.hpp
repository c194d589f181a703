#pragma once

#include <cstdint>
#include <vector>

#include "support/exact/exact_shape.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::oracle {

/// Says by brute force which features of one shape are looked at against each other. No two vertices of
/// theirs are within so many edges of each other, and at rest they are not nearer than a distance.
class SelfPairs {
 public:
  /// With a distance of 0 it does not matter how near features are at rest.
  SelfPairs(const Shape& rest, std::uint32_t rings, double rest_distance);

  [[nodiscard]] bool may(const Feature& a, const Feature& b) const;
  /// Whether two features share no vertex.
  [[nodiscard]] bool may_pierce(const Feature& a, const Feature& b) const;
  /// Refers to this.
  [[nodiscard]] FacePairs pairs() const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> vertices_of(const Feature& feature) const;
  [[nodiscard]] std::uint32_t fewest_edges(const Feature& a, const Feature& b) const;
  [[nodiscard]] const Extent& extent_of(const Feature& feature) const;
  [[nodiscard]] bool are_near_at_rest(const Feature& a, const Feature& b) const;
  [[nodiscard]] Rational rest_distance_squared(const Feature& a, const Feature& b) const;

  ExactShape rest_;
  std::uint32_t rings_;
  Limit limit_;
  std::vector<std::vector<std::uint32_t>> edges_between_;  ///< by vertex and vertex
};

/// The contacts of a shape with itself, which are met in both orders, each once with the lower feature first.
std::vector<Named> each_once(std::vector<Named> contacts);

}  // namespace graze::oracle
