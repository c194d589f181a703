#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/near_list.hpp"
#include "solid/segment_crossing.hpp"

namespace graze {

/// The two places of b at which a contour is found: moved by a shift, or by its opposite. The answer is half
/// of the sum over both.
enum class Shift : std::uint8_t { up = 1, down = 2, both = 3 };

/// An end of the segment in which a triangle of a and one of b cross.
struct ContourEnd {
  std::uint64_t of_a = 0;  ///< the triangle: twice its face, and 1 more for a quad's second triangle
  std::uint64_t of_b = 0;
  std::uint32_t point = 0;  ///< into the list of points
  Shift shift = Shift::both;
  bool is_start = false;  ///< of the segment, which is directed along n_a × n_b
};

/// A segment of the contour by its two points.
struct ContourSegment {
  std::uint32_t start = 0;
  std::uint32_t end = 0;
  Shift shift = Shift::both;

  /// How much it counts: half where it is there with one shift alone.
  [[nodiscard]] double weight() const { return shift == Shift::both ? 1 : 0.5; }
};

/// The vector area of a contour and its middle.
struct ContourArea {
  /// ½ Σ (p − middle) × (q − middle) over the segments p-q, relative to the square of the contour's size.
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  /// The length of the area, divided by the sum of the lengths of its terms. It is 0 for a contour that is no
  /// wider than the shift.
  double fullness = 0;
};

/// Working memory for contours.
struct ContourScratch {
  std::vector<Eigen::Vector3d> points;
  std::vector<ContourEnd> ends;
  std::vector<ContourSegment> segments;

  /// How many points there is room for ahead of time. SceneCapacity states it.
  static constexpr std::size_t reserved = 4096;
  void reserve() {
    points.reserve(reserved);
    ends.reserve(2 * reserved);
    segments.reserve(2 * reserved);
  }
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.points, self.ends, self.segments);
  }
};

/// The contour in which the triangles of two surfaces cross, made from the places where edges and diagonals
/// cross triangles. Each such place is an end of one segment for each triangle beside the edge.
///
/// It is found twice, with b moved by a tiny shift and by its opposite. So surfaces that share a plane cross
/// there with one of the two, and it does not matter whether they share it to the last bit. What is left
/// undecided then goes by `Nudge`, and both contours are closed wherever the surfaces are.
class Contour {
 public:
  Contour(const SurfacePair& pair, ContourScratch& scratch);

  /// How far b is moved, at most.
  [[nodiscard]] double shift_length() const;
  /// Adds the places where an edge or diagonal of one surface crosses the triangles of a face of the other.
  /// Add each pair once. Triangles whose groups are ignored do not count.
  void add(const FeaturePair& pair);
  /// Joins the places to segments, when all are there.
  void join();

  /// Whether the surfaces cross with b moved by the shift as well as by its opposite.
  [[nodiscard]] bool crosses_either_way() const;
  /// Calls `visit(point)` for the ends of all segments.
  template <typename Visit>
  void visit_points(const Visit& visit) const {
    for (const ContourSegment& segment : scratch_.segments)
      for (const std::uint32_t point : {segment.start, segment.end}) visit(scratch_.points[point]);
  }
  [[nodiscard]] ContourArea area() const;

 private:
  /// A segment of one surface that may cross a triangle of the other.
  struct Candidate {
    bool is_of_a;
    FeatureRef segment;
    Simplex along;
    std::uint32_t face;
    Simplex triangle;
    std::uint64_t triangle_number;
  };

  void add(const Candidate& candidate);
  void add_shifted(const Candidate& candidate, Shift shift);
  void add_place(const Candidate& candidate, bool to_front, Shift shift, const Eigen::Vector3d& point);
  template <typename Visit>
  void visit_triangles_beside(const Candidate& candidate, const Visit& visit) const;
  void join_ends(std::span<const ContourEnd> ends);

  const SurfacePair& pair_;
  ContourScratch& scratch_;
  Eigen::Vector3d shift_;
};

}  // namespace graze
