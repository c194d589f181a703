#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <span>
#include <vector>

#include "core/base/moving_box.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A surface on its way through one step, as a sweep sees it. Every vertex moves along a straight line.
struct MovingSurface {
  const Surface& end;                       ///< at time 1
  std::span<const Eigen::Vector3d> start;   ///< by vertex, at time 0. It is empty if the surface stands
  std::span<const MovingBox> face_boxes{};  ///< by region: of its vertices, and of what it owns

  [[nodiscard]] const IndexedMesh& mesh() const { return end.mesh(); }
  [[nodiscard]] Eigen::Vector3d at_start(std::uint32_t vertex) const {
    return start.empty() ? end.position(vertex) : start[vertex];
  }
  [[nodiscard]] Eigen::Vector3d at_end(std::uint32_t vertex) const { return end.position(vertex); }
};

/// Keeps where the vertices of a surface were before it was given other positions, and makes the bounds of
/// the way between. One thread changes it at a time. While none does, any number may read.
class GRAZE_API SurfaceMotion {
 public:
  /// Makes room for all that is kept of a surface of that mesh.
  void reserve(const IndexedMesh& mesh);
  /// Makes room for the positions that a surface has now.
  void make_room(const Surface& now) { start_.resize(now.mesh().vertex_count()); }
  /// Keeps the positions from vertex `begin` to `end`. Several threads may keep ranges that do not overlap.
  void keep(const Surface& now, std::uint32_t begin, std::uint32_t end);
  /// Ends keeping them. Nothing above says where the surface was before this.
  void finish(const Surface& now);

  /// Whether the surface has other positions than those that were kept.
  [[nodiscard]] bool differs_from(const Surface& now) const { return start_version_ != now.version(); }
  /// The box of the kept positions.
  [[nodiscard]] const Box& start_box() const { return start_box_; }

  /// Makes the boxes of all regions for the way from the kept positions to those of now, or for standing
  /// there. It is free if they are already.
  void make_boxes(const Surface& now, bool moves);
  /// The way of the last `make_boxes`.
  [[nodiscard]] MovingSurface way(const Surface& now, bool moves) const {
    return {now, moves ? std::span<const Eigen::Vector3d>(start_) : std::span<const Eigen::Vector3d>(),
            boxes_};
  }

  /// Bytes held.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  std::vector<Eigen::Vector3d> start_;
  Box start_box_;
  std::uint64_t start_version_ = 0;  ///< of the surface
  std::vector<MovingBox> boxes_;
  // The versions of both ends that the boxes are of. They are equal if the surface stands.
  std::uint64_t boxes_start_ = 0;
  std::uint64_t boxes_end_ = 0;
};

}  // namespace graze
