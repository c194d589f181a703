#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "models/models.hpp"
#include "support/model_shape.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// A surface at rest and as it is now.
struct Body {
  Body(oracle::Shape shape) : rest(shape), now(std::move(shape)) {}  // NOLINT(google-explicit-constructor)
  Body(oracle::Shape rest_shape, oracle::Shape now_shape)
      : rest(std::move(rest_shape)), now(std::move(now_shape)) {}

  oracle::Shape rest;
  oracle::Shape now;
};

/// Every position times `factor`, plus `offset`.
oracle::Shape mapped(oracle::Shape shape, double factor, const Eigen::Vector3d& offset);
/// Every coordinate rounded to a multiple of `step`.
oracle::Shape snapped(oracle::Shape shape, double step);
/// Deformed in smooth waves of up to `size` along each axis.
oracle::Shape wobbled(oracle::Shape shape, double size, std::uint64_t seed);
/// Turned by angles of the seed.
oracle::Shape turned(oracle::Shape shape, std::uint64_t seed);
/// Moved so that the lowest corner of its box is at `beside`, of the other shape's box the highest along
/// `axis`, plus `gap`.
oracle::Shape placed_beside(oracle::Shape shape, const oracle::Shape& other, int axis, double gap);

/// Faces of 3 or 4 corners drawn at random from `vertex_count` vertices, some of them unused and NaN, in a
/// unit cube, on a grid of quarters for odd seeds.
oracle::Shape random_soup(std::uint64_t seed, std::uint32_t vertex_count, std::uint32_t face_count);

oracle::Shape triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r);
oracle::Shape quad(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                   const Eigen::Vector3d& s);
/// A closed box of quads wound outward. Corner i is at the upper end of axis k where bit k of i is set.
oracle::Shape box(const Eigen::Vector3d& low, const Eigen::Vector3d& size);

struct NamedShape {
  std::string name;
  oracle::Shape shape;
};
/// Two surfaces of which one drifts.
struct DriftingPair {
  const char* name;
  oracle::Shape a;
  oracle::Shape b;
  double apart;  ///< their middles, along x
  double drift;  ///< further apart in each step
};

/// The five models of the paper as triangles.
const std::vector<NamedShape>& paper_models();
/// The models of the paper that are available as quads.
const std::vector<NamedShape>& paper_models_of_quads();

}  // namespace graze::tests
