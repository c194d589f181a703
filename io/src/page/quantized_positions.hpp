#pragma once

#include <Eigen/Core>
#include <graze/mesh.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

using SharedPositions = std::shared_ptr<const std::vector<Eigen::Vector3d>>;

/// Positions of an object in some frames as whole numbers: position = origin + step · number.
struct QuantizedPositions {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double step = 1;    ///< a power of two
  double error = 0;   ///< the largest of any coordinate that is drawn
  std::string bytes;  ///< of all frames, as docs/page_format.md says
};

/// Quantizes the positions of some frames. The step is at most 2^-15 of the object's size in the first of
/// them, so the error is at most 2^-16 of it. Where vertices are further than 2^15 sizes apart in these
/// frames the step is larger, so that the numbers fit into 32 bits.
QuantizedPositions quantized(const Mesh& mesh, std::span<const SharedPositions> frames);

}  // namespace graze::io
