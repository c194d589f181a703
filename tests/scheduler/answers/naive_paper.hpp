#pragma once

#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// A contact of the paper's method: a vertex of each object and their distance.
struct PaperContact {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double distance = 0;
  friend auto operator<=>(const PaperContact&, const PaperContact&) = default;
};

/// The paper's method written down as plainly as can be: DMV by recursion over the oracle's regions, DV from
/// the closest vertices of two leaves. In double, so for shapes without ties. `epsilon` is e1 to ek. Without
/// numbers the levels' are eq. 3 summed as in eq. 6.
class NaivePaper {
 public:
  NaivePaper(const oracle::Shape& rest_a, const oracle::Shape& rest_b,
             const std::vector<Eigen::Vector3d>& now_a, const std::vector<Eigen::Vector3d>& now_b);

  struct Found {
    std::vector<PaperContact> contacts;  ///< sorted, each once
    std::size_t leaf_pairs = 0;
  };
  /// With `every_pair` all vertex pairs of the leaf pairs reached, else where DV's walks end.
  [[nodiscard]] Found find(const std::vector<double>& epsilon, double threshold, bool every_pair) const;

 private:
  struct Tree {
    Tree(const oracle::Shape& rest, const std::vector<Eigen::Vector3d>& positions);
    [[nodiscard]] std::vector<std::size_t> expanded(std::size_t region) const;

    std::vector<oracle::OracleRegion> regions;
    std::vector<std::vector<std::size_t>> children;
    std::vector<std::vector<std::uint32_t>> neighbours;
    std::vector<double> level_radii;
    std::vector<Eigen::Vector3d> now;
  };
  class Search;

  Tree a_, b_;
};

}  // namespace graze::tests
