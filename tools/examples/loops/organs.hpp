#pragma once

#include <string>

#include "examples/loops/shape.hpp"

namespace loops {

/// Two organs that touch, as they are at rest. Lengths are in mm.
struct Organs {
  Shape shapes[2];
  bool are_real = false;
};

/// Reads the last two objects of an OBJ file of triangles. Without a file, returns two blobs.
Organs load_organs(const std::string& file);

/// Writes the points of an organ at a time in seconds. It breathes: all of it moves to and fro by up to 3 mm.
/// A wave of 1 mm runs through it besides.
void deform(const Shape& rest, double time, std::vector<Eigen::Vector3f>& points);

}  // namespace loops
