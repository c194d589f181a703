#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/box.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>
#include <memory>
#include <span>
#include <vector>

namespace graze {

/// A mark on the way that a surface's vertices make. Between two marks of one epoch no vertex came further
/// than the difference of their distances; a jump begins a new epoch.
struct Travel {
  std::uint64_t epoch = 0;
  double distance = 0;
};

/// Which bounds of regions a refit makes.
enum class RefitOf : std::uint8_t { vertices, faces };

/// A mesh at the positions it has now, and the bounds of its regions there or where they were a while ago.
/// One thread changes it at a time; while none does, any number may read.
class GRAZE_API Surface {
 public:
  /// At the mesh's rest shape, not yet refitted. Throws Error for a null mesh.
  explicit Surface(std::shared_ptr<const Mesh> mesh);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const std::shared_ptr<const Mesh>& shared_mesh() const { return mesh_; }
  /// One for each vertex; those of unused vertices mean nothing.
  [[nodiscard]] std::span<const Eigen::Vector3d> positions() const { return positions_; }
  [[nodiscard]] const Eigen::Vector3d& position(std::uint32_t vertex) const { return positions_[vertex]; }
  /// The box of the used vertices, and so of the faces.
  [[nodiscard]] const Box& box() const { return box_; }

  /// Whether a position can be worked with: finite, and no coordinate beyond 2^120.
  [[nodiscard]] static bool is_within_limits(const Eigen::Vector3d& position);

  /// What came of reading positions.
  struct ReadResult {
    static constexpr std::uint32_t no_vertex = Mesh::no_edge;
    /// The first used vertex that is not finite or has a coordinate beyond 2^120; then nothing was taken.
    std::uint32_t bad_vertex = no_vertex;
    Eigen::Vector3d bad_position = Eigen::Vector3d::Zero();
    /// How far the used vertex that moved furthest did.
    double displacement = 0;

    [[nodiscard]] bool taken() const { return bad_vertex == no_vertex; }
  };
  /// Takes all of `view`, which has one position for each vertex, or nothing. Unused vertices are not read.
  ReadResult set_positions(const PositionView& view);
  /// Places the rest shape: vertex = ((r0·x + r1·y) + r2·z) + t, for the rows (r0, r1, r2, t) of the pose.
  ReadResult set_pose(const std::array<double, 12>& rows);

  /// What reading some of the vertices found.
  struct PartRead {
    /// The first, as in ReadResult; nothing after it was read.
    std::uint32_t bad_vertex = ReadResult::no_vertex;
    Eigen::Vector3d bad_position = Eigen::Vector3d::Zero();
    double furthest_squared = 0;
    bool changed = false;
    Box box;

    /// Adds what was found in the vertices that come after.
    void add(const PartRead& later);
  };
  /// The same in parts: reads the vertices from `begin` to `end` and puts them aside; then `take` takes them
  /// all, for what their parts found together. Several threads may read parts that do not overlap at once.
  PartRead read_positions(const PositionView& view, std::uint32_t begin, std::uint32_t end);
  PartRead read_pose(const std::array<double, 12>& rows, std::uint32_t begin, std::uint32_t end);
  ReadResult take(const PartRead& all);

  /// Never another surface's in this process.
  [[nodiscard]] std::uint64_t serial() const { return serial_; }
  /// Changes whenever any used vertex does, by any bit.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] Travel travel() const { return travel_; }
  /// At least how far any used vertex is from where it was at `then`; infinite where that is not known.
  [[nodiscard]] double motion_since(const Travel& then) const;
  /// ReadResult::displacement of the last positions taken.
  [[nodiscard]] double displacement() const { return displacement_; }
  /// About the size of a leaf: the longest side of the box, halved once for each level of
  /// the tree down to where most leaves are.
  [[nodiscard]] double leaf_size() const;

  /// Makes the bounds of all regions those of the present positions; free if they are already.
  ///
  /// Vertex bounds: a radius about the middle vertex (eq. 2) and a box, of the region's vertices. Surface
  /// bounds: a box of the vertices and all corners of the faces and edges that the region owns.
  void refit_vertices() { refit(RefitOf::vertices); }
  void refit_faces() { refit(RefitOf::faces); }
  void refit(RefitOf what);
  /// The same in parts: `begin_refit`, then ranges of regions that do not overlap and are all of them
  /// together, by several threads at once if need be, then `finish_refit`.
  void begin_refit(RefitOf what);
  void refit_regions(RefitOf what, std::uint32_t begin, std::uint32_t end);
  void finish_refit(RefitOf what);
  /// At least how far any used vertex is from where the last refit saw it: 0 where the bounds are those of
  /// the present positions, infinite before the first refit and after a jump.
  [[nodiscard]] double motion_since_vertex_refit() const { return motion_since_refit(RefitOf::vertices); }
  [[nodiscard]] double motion_since_face_refit() const { return motion_since_refit(RefitOf::faces); }
  [[nodiscard]] double motion_since_refit(RefitOf what) const;
  /// The boxes of one region at the present positions, made from its vertices and faces.
  [[nodiscard]] Box vertex_box_now(const Region& region) const;
  [[nodiscard]] Box face_box_now(const Region& region) const;

  /// Of the last refit_vertices: eq. 2, one for each region.
  [[nodiscard]] std::span<const double> radii() const { return radii_; }
  [[nodiscard]] std::span<const Box> vertex_boxes() const { return vertex_boxes_; }
  /// Of the last refit_vertices: eq. 3, one for each level.
  [[nodiscard]] std::span<const double> level_radii() const { return level_radii_; }
  /// Of the last refit_faces, one for each region.
  [[nodiscard]] std::span<const Box> face_boxes() const { return face_boxes_; }

  [[nodiscard]] const Eigen::Vector3d& middle(const Region& region) const {
    return positions_[region.middle];
  }

  /// Bytes held; the mesh is not counted.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// When bounds were last made.
  struct Refit {
    std::uint64_t version = 0;  ///< 0 before the first
    Travel travel;
  };

  template <typename PositionOf>
  PartRead read(std::uint32_t begin, std::uint32_t end, const PositionOf& position_of);
  void refit_vertices_of(std::uint32_t index);
  void finish_vertex_refit();
  void finish_face_refit();
  void count_motion(double displacement, const Box& before);
  [[nodiscard]] double motion_since(const Refit& refit) const;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Vector3d>
      incoming_;  ///< where positions are read to before all of them are known to be good
  Box box_;
  std::vector<double> radii_;
  std::vector<double> level_radii_;
  std::vector<Box> vertex_boxes_;
  std::vector<Box> face_boxes_;
  std::uint64_t serial_;
  std::uint64_t version_ = 0;
  Travel travel_;
  double displacement_ = 0;
  Refit vertex_refit_;
  Refit face_refit_;
};

}  // namespace graze
