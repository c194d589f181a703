#pragma once

#include <Eigen/Core>
#include <array>
#include <compare>
#include <cstdint>
#include <graze/mesh.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/box.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/pair/leaf_front.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// An object in one frame, with what the paper's method needs of it. Made from the positions alone.
class PlacedObject {
 public:
  PlacedObject(const RecordedObject& object, std::size_t frame);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const RegionTree& tree() const { return indexed(*mesh_).regions(); }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// By region: the largest distance of a vertex from the middle vertex (eq. 2).
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  /// By level: the largest of its regions' (eq. 3).
  [[nodiscard]] const std::vector<double>& level_radii() const { return level_radii_; }
  /// The leaf regions, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& leaves() const { return leaves_; }
  /// By region: of its vertices.
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  const Mesh* mesh_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> radii_;
  std::vector<double> level_radii_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Box> boxes_;
};

/// Two vertices and the square of their distance, which double holds exactly for recorded positions. The
/// lesser is the nearer, then that of the lower vertices.
struct VertexPair {
  double squared = 0;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

/// The results of the paper's method for two leaf regions.
struct LeafPair {
  std::uint32_t a = 0;  ///< region of a
  std::uint32_t b = 0;
  VertexPair nearest;  ///< eq. 5
  VertexPair walked;   ///< where DV's walk from there ends (figure 5)
};

/// The numbers of one row of the paper's tables for a kind of pair, and how they are read.
struct PaperNumbers {
  std::vector<double>
      epsilon;      ///< by level from 1, the last for deeper ones too. Empty for eq. 3 summed as in eq. 6
  double last = 0;  ///< DV's
  bool test_leaves = false;  ///< whether pairs of leaves, too, have to pass eq. 4 before DV
};

/// The work of the paper's method on two objects in one frame.
struct PaperFound {
  static constexpr std::size_t most_levels = 8;
  std::array<std::uint64_t, most_levels> passed{};  ///< pairs of regions that pass eq. 4, by level
  std::array<std::uint64_t, most_levels>
      expanded{};                      ///< those of them that are not both leaves. Level 0 has the roots
  std::vector<std::uint32_t> reached;  ///< pairs of leaves given to DV: numbers of PaperWalk::leaves
};

/// The paper's DMV and DV (sections 3.2 and 3.3) on two objects in one frame. They are written in double, as
/// plainly as can be, to compare the library with. All pairs of leaves are found, too, and none is left out.
class PaperWalk {
 public:
  /// Both must outlive it.
  PaperWalk(const PlacedObject& a, const PlacedObject& b) : a_(a), b_(b) {}

  [[nodiscard]] PaperFound find(const PaperNumbers& numbers);
  /// Finds all pairs of leaves that have vertices nearer than `threshold`. Returns numbers of `leaves`,
  /// ascending by regions.
  [[nodiscard]] std::vector<std::uint32_t> near_leaves(double threshold);
  [[nodiscard]] const LeafPair& leaves(std::uint32_t number) const { return leaves_[number]; }
  /// How many have a number by now.
  [[nodiscard]] std::size_t leaf_pair_count() const { return leaves_.size(); }
  /// Finds all pairs of vertices nearer than `threshold`, sorted by the vertices.
  [[nodiscard]] std::vector<VertexPair> near_vertices(double threshold);
  /// The nearest vertices of all.
  [[nodiscard]] VertexPair nearest_vertices() const;

 private:
  [[nodiscard]] VertexPair pair_of(std::uint32_t a, std::uint32_t b) const {
    return {(a_.points()[a] - b_.points()[b]).squaredNorm(), a, b};
  }
  [[nodiscard]] bool passes(const PaperNumbers& numbers, const Region& a, const Region& b,
                            std::size_t level) const;
  template <typename Visit>
  void for_each_pair_of_leaves(const Visit& visit) const {
    for (const std::uint32_t a : a_.leaves())
      for (const std::uint32_t b : b_.leaves()) visit(a, b);
  }
  void visit(const PaperNumbers& numbers, std::uint32_t a, std::uint32_t b, std::size_t level,
             PaperFound& found);
  std::uint32_t number_of(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] VertexPair nearest_of(const Region& a, const Region& b) const;
  [[nodiscard]] VertexPair walk_from(VertexPair at) const;

  const PlacedObject& a_;
  const PlacedObject& b_;
  std::vector<LeafPair> leaves_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  ///< of `leaves_`, by both regions
};

}  // namespace graze::tools
