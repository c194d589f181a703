#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// Two frames of a simulation (../shared/data/README.md), with exact answers to which of its features meet on
/// straight ways from the first frame to the second one.
struct Sequence {
  /// Two features whose boxes meet on the way.
  struct Pair {
    bool are_edges = false;
    /// A vertex and a face, or two of #edges.
    std::array<std::size_t, 2> features{};
    bool meet = false;
  };

  oracle::Shape start;
  std::vector<Eigen::Vector3d> end;
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< each with its lower vertex first
  std::vector<Pair> pairs;
};

/// Reads the frames `first` and `first` + 1. If the shared data is missing, says so and returns nothing.
std::optional<Sequence> read_sequence(const std::string& name, int first);

}  // namespace graze::tests
