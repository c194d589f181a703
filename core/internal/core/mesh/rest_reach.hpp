#pragma once

#include <Eigen/Core>
#include <array>
#include <graze/export.hpp>
#include <vector>

#include "core/base/box.hpp"
#include "core/base/bytes_of.hpp"

namespace graze {

class IndexedMesh;

/// How far a mesh's rest shape reaches in any direction, so that the box of a posed object needs none of its
/// vertices.
///
/// The reach in a direction is the largest dot product of it and a vertex. It is convex and grows with the
/// direction's length. So in w0·p0 + w1·p1 + w2·p2, with weights above zero, it is at most the same sum of
/// the reaches in p0, p1 and p2. These are listed for directions on the faces of a cube, eight squares along
/// each edge. For a sphere the bound is at most a hundredth of the radius too large.
class GRAZE_API RestReach {
 public:
  explicit RestReach(const IndexedMesh& mesh);

  /// A box of all used vertices at ((r0·x + r1·y) + r2·z) + t as doubles round it, for the rows (r0, r1, r2,
  /// t). The matrix may be any finite one. The box is infinite where vertices may be beyond the range of
  /// double.
  [[nodiscard]] Box box_at(const std::array<double, 12>& rows) const;

  /// At least how far any used vertex is at one matrix from where it is at another, both as doubles round it.
  [[nodiscard]] double motion_between(const std::array<double, 12>& before,
                                      const std::array<double, 12>& now) const;

  [[nodiscard]] std::size_t byte_count() const { return sizeof(RestReach) + bytes_of(reaches_); }

 private:
  /// From `centre_`, in a direction and in the opposite one.
  struct Both {
    double ahead = 0, behind = 0;
  };

  /// At most how far a coordinate of a vertex is from what it is without rounding.
  [[nodiscard]] double slack_of(const double* row) const;
  [[nodiscard]] Both reach_in(const Eigen::Vector3d& direction) const;

  std::vector<Both> reaches_;  ///< by the direction's longest axis, then along the next one and the last one
  Box rest_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d furthest_ = Eigen::Vector3d::Zero();  ///< of any vertex from the origin, along each axis
  double size_ = 0;  ///< at least the sum of the coordinates of any vertex from the centre
};

}  // namespace graze
