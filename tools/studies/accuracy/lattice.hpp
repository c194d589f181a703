#pragma once

#include <Eigen/Core>

#include "support/oracle/oracle.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tools {

/// Points o + i u + j v + k w that doubles hold exactly, so that what is meant to be parallel, flat,
/// collinear or touching is so exactly.
class Lattice {
 public:
  /// `longest` is how long a needle along u is in steps of `shortest` along v. Both are 64 for none.
  Lattice(oracle::Random& random, double longest, double shortest);

  [[nodiscard]] Eigen::Vector3d at(double i, double j, double k) const {
    return (i * u_ + j * v_ + k * w_) * step_;
  }
  /// A random whole number of steps along u, and along v.
  double i();
  double j();

  /// A triangle, or a flat quad (a parallelogram, or any four points), at height k.
  oracle::Shape flat_face(bool quad, double k);
  /// A triangle whose edge (0, 1) is at height k, the third corner beyond.
  oracle::Shape face_on_edge(double k);

 private:
  oracle::Random& random_;
  double longest_, shortest_, step_;
  Eigen::Vector3d u_, v_, w_;
};

/// Two faces with parallel edges, an edge parallel to a face, or parallel faces. They are at distance 0 if
/// `apart` is false.
std::array<oracle::Shape, 2> parallel_shapes(oracle::Random& random, bool needles, bool apart);

/// A face whose corners are collinear, share a place, or are one vertex.
oracle::Shape collapsed_face(oracle::Random& random);

/// Two flat faces, one of which has a corner in, on the border or on a corner of the other.
std::array<oracle::Shape, 2> touching_shapes(oracle::Random& random);

}  // namespace graze::tools
