#pragma once

#include <string>

#include "examples/loops/options.hpp"
#include "examples/loops/shape.hpp"

namespace loops {

/// Two organs that touch, as they are at rest. Lengths are in mm.
struct Organs {
  Shape shapes[2];
  std::string names[2];
  std::string source;  ///< where they come from, in words
  bool are_real = false;
};

/// Reads two organs of triangles from the file that the options name, or from the shared data if it is there.
/// Without a file, or if the options ask for it, returns two generated blobs. Throws graze::Error if a file
/// cannot be used.
Organs load_organs(const Options& options);

/// Writes the points of an organ at a time in seconds. It breathes: all of it moves to and fro by up to 3 mm.
/// A wave of 1 mm runs through it besides.
void deform(const Shape& rest, double time, std::vector<Eigen::Vector3f>& points);

}  // namespace loops
