#pragma once

#include "models/models.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// A generated model as the oracles take it.
inline oracle::Shape shape_of(const models::MeshData& data) {
  oracle::Shape shape{data.positions, {}};
  auto corner = data.corners.begin();
  for (const std::uint32_t count : data.corner_counts) {
    shape.faces.emplace_back(corner, corner + count);
    corner += count;
  }
  return shape;
}

}  // namespace graze::tests
