#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "support/comparison.hpp"
#include "support/oracle/oracle_edges.hpp"

namespace graze::tests {

/// What brute force says of all pairs of edges of two shapes.
std::vector<oracle::EdgePair> edge_pairs_of(const oracle::Shape& a, const oracle::Shape& b, double threshold,
                                            const oracle::Creases& creases,
                                            const oracle::FacePairs& pairs = {});

/// Describes how the contacts of kind EE of `nearest` or `features` differ from the oracle's. Empty if they
/// do not. Compared are the set, sides, whether they are sunk, separation and push.
std::string edge_difference(ContactDetail detail, std::span<const Contact> contacts,
                            const std::vector<oracle::EdgePair>& expected, const Tolerance& tolerance);

/// Counts pairs of edges by what the oracle says of them, so that a test can assert that no case is missing.
struct EdgeTally {
  std::size_t judged = 0;
  std::size_t locally_closest = 0;
  std::size_t patches_only = 0;  ///< listed only since they bound a patch
  std::size_t sunk = 0;
  std::size_t sunk_and_listed = 0;
  std::size_t behind_only = 0;  ///< both sides are `back`, but nothing pierces
  std::size_t crossing = 0;     ///< at distance 0
  std::size_t flat = 0;         ///< locally closest, but left out since an edge lies flat
  std::size_t left_out = 0;

  void count(const std::vector<oracle::EdgePair>& pairs);
  void print(const char* what) const;
};

}  // namespace graze::tests
