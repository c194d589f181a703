#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/export.hpp>
#include <graze/position_view.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/box.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/surface/oriented_box.hpp"
#include "core/surface/vertex_blocks.hpp"
#include "core/surface/vertex_stretches.hpp"

namespace graze {

/// A mark on the way that a surface's vertices make. Between two marks of one epoch no vertex came further
/// than the difference of their distances. A jump begins a new epoch.
struct Travel {
  std::uint64_t epoch = 0;
  double distance = 0;
};

/// Which bounds of regions a refit makes.
enum class RefitOf : std::uint8_t {
  vertices,  ///< a box of the region's vertices
  faces,     ///< a box of those and of all corners of the faces and edges that the region owns
  radii,  ///< about the middle vertex (eq. 2), and of levels (eq. 3). AccuracyMode::paper alone asks for them
};

/// A mesh at the positions it has now, and the bounds of its regions there or where they were a while ago.
/// While it stands at rest its positions are the mesh's, and take no memory. One thread changes it at a time.
/// While none does, any number may read.
class GRAZE_API Surface {
 public:
  /// At the mesh's rest shape, not yet refitted. Throws Error for a null mesh.
  explicit Surface(std::shared_ptr<const Mesh> mesh);
  explicit Surface(std::shared_ptr<const IndexedMesh> mesh);

  /// Takes the place of another surface, at its own rest shape: its version follows the other's, and the
  /// change is a jump. Call it before the surface is given positions.
  void succeed(const Surface& before);

  [[nodiscard]] const IndexedMesh& mesh() const { return *mesh_; }
  [[nodiscard]] const std::shared_ptr<const IndexedMesh>& shared_mesh() const { return mesh_; }
  /// The position of a vertex. That of an unused one means nothing.
  [[nodiscard]] Eigen::Vector3d position(std::uint32_t vertex) const {
    if (viewed_.data() != nullptr) return viewed_[vertex];
    if (in_double_.empty()) return in_float_[vertex].cast<double>();
    return in_double_[vertex];
  }
  /// All of them, as they lie in memory, until they are set again.
  [[nodiscard]] PositionView positions() const {
    if (viewed_.data() != nullptr) return viewed_;
    return in_double_.empty() ? PositionView(in_float_) : PositionView(in_double_);
  }
  /// The box of the used vertices, and so of the faces.
  [[nodiscard]] const Box& box() const { return box_; }

  /// Whether a position can be worked with: finite, and no coordinate beyond 2^120.
  [[nodiscard]] static bool is_within_limits(const Eigen::Vector3d& position);

  /// The result of reading positions.
  struct ReadResult {
    static constexpr std::uint32_t no_vertex = IndexedMesh::no_edge;
    /// The first used vertex that is not finite or has a coordinate beyond 2^120. Then nothing was taken.
    std::uint32_t bad_vertex = no_vertex;
    Eigen::Vector3d bad_position = Eigen::Vector3d::Zero();
    /// How far the used vertex that moved furthest did. With Displacement::bound at least that.
    double displacement = 0;
    /// Whether some used vertex has other bits than before.
    bool changed = false;

    [[nodiscard]] bool taken() const { return bad_vertex == no_vertex; }
  };
  /// How ReadResult::displacement is found. A bound takes one quick pass and is at most √3 times too large.
  /// It is infinite where positions come in another precision than before.
  enum class Displacement : std::uint8_t { exact, bound };
  /// Takes the positions of another surface of the same mesh, and refits for faces.
  void copy_refitted(const Surface& from);
  /// Takes all of `view`, which has one position for each vertex, or nothing, also where there is no memory
  /// for it (std::bad_alloc). Unused vertices are not read.
  ReadResult set_positions(const PositionView& view);
  /// Returns where a pose puts a point of the rest shape: ((r0·x + r1·y) + r2·z) + t, for the rows
  /// (r0, r1, r2, t).
  [[nodiscard]] static Eigen::Vector3d posed(const std::array<double, 12>& rows,
                                             const Eigen::Vector3d& point);
  /// Poses the rest shape.
  /// From one pose to another the displacement is a bound, by the corners of the rest shape's box, and
  /// another pose is a change.
  ReadResult set_pose(const std::array<double, 12>& rows);

  /// The result of scanning some of the new positions.
  struct PartSeen {
    /// The first bad vertex, as in ReadResult. No vertex after it was scanned.
    std::uint32_t bad_vertex = ReadResult::no_vertex;
    Eigen::Vector3d bad_position = Eigen::Vector3d::Zero();
    double furthest_squared = 0;
    Eigen::Vector3d furthest = Eigen::Vector3d::Zero();  ///< along each axis, where only a bound was wanted
    bool changed = false;
    bool in_double = true;  ///< as the positions are given
    Box box;

    /// Adds what was found in the vertices that come after.
    void add(const PartSeen& later);
  };
  /// Reading by several threads has three phases. First scan the vertices from `begin` to `end`. Several
  /// threads may scan ranges that do not overlap. Then `accept` what all scans found together. If that says
  /// that something changed, write the positions, again by ranges. Between `accept` and the last write the
  /// surface's positions must not be read.
  [[nodiscard]] PartSeen scan_positions(const PositionView& view, std::uint32_t begin, std::uint32_t end,
                                        Displacement displacement = Displacement::exact) const;
  [[nodiscard]] PartSeen scan_pose(const std::array<double, 12>& rows, std::uint32_t begin,
                                   std::uint32_t end) const;
  ReadResult accept(const PartSeen& all);
  /// Uses positions where they lie. They are this surface's until it is given others, and none is to be
  /// written.
  ReadResult take_in_place(const PartSeen& all, const PositionView& view);
  void write_positions(const PositionView& view, std::uint32_t begin, std::uint32_t end);
  void write_pose(const std::array<double, 12>& rows, std::uint32_t begin, std::uint32_t end);
  /// Makes room for positions in a precision.
  void reserve_positions(bool in_double);
  /// Whether positions are good, and their box, without a surface to compare them with: `changed` and the
  /// motion say nothing.
  [[nodiscard]] static PartSeen survey(const IndexedMesh& mesh, const PositionView& view, std::uint32_t begin,
                                       std::uint32_t end);

  /// Whether positions can be viewed where they are: one beside the other, all of them used.
  [[nodiscard]] bool can_view(const PositionView& view) const;
  /// Views positions where they are, instead of reading them. A survey has found them good, in that box. They
  /// are this surface's until `end_view`, and how far they moved is not known. After that its positions are
  /// of no use before it is read again or has another view.
  void view(const PositionView& view, const Box& box);
  void end_view();
  /// Whether it has had a view since it was read.
  [[nodiscard]] bool is_behind() const { return is_behind_; }

  /// Never another surface's in this process.
  [[nodiscard]] std::uint64_t serial() const { return serial_; }
  /// Changes whenever any used vertex does, by any bit.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] Travel travel() const { return travel_; }
  /// At least how far any used vertex is from where it was at `then`. It is infinite where that is not known.
  [[nodiscard]] double motion_since(const Travel& then) const;
  /// ReadResult::displacement of the last positions taken.
  [[nodiscard]] double displacement() const { return displacement_; }
  /// About the size of a leaf: the longest side of the box, halved once for each level of
  /// the tree down to where most leaves are.
  [[nodiscard]] double leaf_size() const;

  /// Makes the bounds of all regions those of the present positions. It is free if they are already.
  void refit(RefitOf what);
  void refit_vertices() { refit(RefitOf::vertices); }
  void refit_faces() { refit(RefitOf::faces); }
  /// A refit by several threads: `begin_refit`, then `refit_regions` for ranges that do not overlap and
  /// together are all regions, then `finish_refit`.
  void begin_refit(RefitOf what);
  void refit_regions(RefitOf what, std::uint32_t begin, std::uint32_t end);
  void finish_refit(RefitOf what);
  /// A bound of how far any used vertex is from where the last refit saw it. It is 0 where the bounds are
  /// those of the present positions, and infinite before the first refit and after a jump.
  [[nodiscard]] double motion_since_vertex_refit() const { return motion_since_refit(RefitOf::vertices); }
  [[nodiscard]] double motion_since_face_refit() const { return motion_since_refit(RefitOf::faces); }
  [[nodiscard]] double motion_since_refit(RefitOf what) const;
  /// The box of a region's vertices at the present positions, or of a leaf's faces.
  [[nodiscard]] Box box_now(const Region& region, RefitOf what) const;

  /// Makes blocks of the vertices at the present positions. It is free if they are already.
  void make_blocks();
  /// The last ones made.
  [[nodiscard]] const VertexBlocks& blocks() const { return blocks_; }
  /// Whether they are those of now.
  [[nodiscard]] bool has_blocks() const { return blocks_version_ == version_; }
  /// Makes stretches at the present positions, for a mesh that has them. They suffice instead of blocks where
  /// few pairs test the surface, each a part of it.
  void make_stretches();
  [[nodiscard]] const VertexStretches& stretches() const { return stretches_; }
  [[nodiscard]] bool has_stretches() const { return stretches_version_ == version_; }

  /// Lets go of all bounds, blocks and stretches, and of their memory: those of now are made anew.
  void forget_bounds() noexcept;

  /// The boxes of the last refits, one for each region.
  [[nodiscard]] std::span<const Box> vertex_boxes() const { return vertex_boxes_; }
  [[nodiscard]] std::span<const Box> face_boxes() const { return face_boxes_; }
  [[nodiscard]] std::span<const Box> boxes(RefitOf what) const {
    return what == RefitOf::vertices ? vertex_boxes_ : face_boxes_;
  }
  /// The boxes along the faces of long regions, in the order of LongRegions, of the last refit of faces.
  [[nodiscard]] std::span<const OrientedBox> oriented_boxes() const { return oriented_boxes_; }
  /// The one of a long leaf at the present positions.
  [[nodiscard]] OrientedBox oriented_box_now(const LongRegions::LongRegion& leaf) const;
  [[nodiscard]] std::span<const double> radii() const { return radii_; }
  /// One for each level.
  [[nodiscard]] std::span<const double> level_radii() const { return level_radii_; }

  [[nodiscard]] Eigen::Vector3d middle(const Region& region) const { return position(region.middle); }

  /// Bytes held. The mesh is not counted.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  friend class SurfacePart;  // it has positions and bounds of some regions alone
  /// When bounds were last made.
  struct Refit {
    std::uint64_t version = 0;  ///< 0 before the first
    Travel travel;
  };

  template <typename PositionOf>
  [[nodiscard]] PartSeen scan(std::uint32_t begin, std::uint32_t end, const PositionOf& position_of) const;
  template <typename PositionOf>
  void write(std::uint32_t begin, std::uint32_t end, const PositionOf& position_of);
  ReadResult take_pose(const std::array<double, 12>& rows);
  [[nodiscard]] bool is_laid_out_like(const PositionView& view) const;
  [[nodiscard]] bool has_own_positions() const { return !in_float_.empty() || !in_double_.empty(); }
  [[nodiscard]] ReadResult result_of(const PartSeen& all) const;
  void count_read(const ReadResult& result, const Box& now);
  void own_positions(bool in_double);
  [[nodiscard]] std::vector<Box>& boxes_to_write(RefitOf what) {
    return what == RefitOf::vertices ? vertex_boxes_ : face_boxes_;
  }
  [[nodiscard]] double radius_now(const Region& region) const;
  void gather_level_radii();
  void box_inner_regions(std::vector<Box>& boxes) const;
  [[nodiscard]] Eigen::Matrix3d axes_of(const LongRegions::LongRegion& region) const;
  void refit_long_leaves(std::uint32_t begin, std::uint32_t end);
  void box_inner_long_regions();
  void count_motion(double displacement, const Box& before);
  [[nodiscard]] double motion_since(const Refit& refit) const;

  std::shared_ptr<const IndexedMesh> mesh_;
  // Positions in the precision in which they came. The other is empty, and both are before any came.
  std::vector<Eigen::Vector3f> in_float_;
  std::vector<Eigen::Vector3d> in_double_;
  std::optional<std::array<double, 12>>
      pose_;                ///< by which they are those of the rest shape, where it is known
  PositionView viewed_;     ///< used instead of these, where there is one, and always while both are empty
  bool is_behind_ = false;  ///< there has been one since they were written
  Box box_;
  std::vector<double> radii_;
  std::vector<double> level_radii_;
  std::vector<Box> vertex_boxes_;
  std::vector<Box> face_boxes_;
  std::vector<OrientedBox> oriented_boxes_;
  std::uint64_t serial_;
  std::uint64_t version_ = 0;
  Travel travel_;
  double displacement_ = 0;
  std::array<Refit, 3> refits_;  ///< by RefitOf
  VertexBlocks blocks_;
  std::uint64_t blocks_version_ = 0;  ///< when they were made
  VertexStretches stretches_;
  std::uint64_t stretches_version_ = 0;
};

}  // namespace graze
