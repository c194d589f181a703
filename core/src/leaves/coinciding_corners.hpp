#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/mesh/region_tree.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// The corners of the features of two leaves that lie at one position. Where surfaces coincide, some hundred
/// pairs of features about a vertex have no other closest points than that corner. So these pairs are settled
/// here, by numbers and a few products, before float and double are asked about each of them.
///
/// Features are given by their numbers in the leaves. Each function returns whether a pair is settled. Then
/// `sink(key, squared range)` has been given all its keys. What it says is true in exact arithmetic.
class CoincidingCorners {
 public:
  /// Begins with two leaves. `any` says whether there is anything to settle.
  void begin(const SurfacePair& pair, const Region& leaf_a, const Region& leaf_b);
  void clear() { any_ = false; }
  [[nodiscard]] bool any() const { return any_; }

  template <typename Sink>
  bool settle_edges(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b, const Sink& sink) {
    const std::uint32_t* const a = a_.edge_ends.data() + 2 * std::size_t{edge_a};
    const std::uint32_t* const b = b_.edge_ends.data() + 2 * std::size_t{edge_b};
    const std::array<std::uint32_t, 2> at_a{a_.position[a[0]], a_.position[a[1]]};
    const std::array<std::uint32_t, 2> at_b{b_.position[b[0]], b_.position[b[1]]};
    const bool same_way = (at_a[0] == at_b[0]) || (at_a[1] == at_b[1]);
    const bool crosswise = (at_a[0] == at_b[1]) || (at_a[1] == at_b[0]);
    if (!same_way && !crosswise) return false;
    const auto point_a = [&](std::size_t end) -> const Eigen::Vector3d& { return a_.point[a[end]]; };
    const auto point_b = [&](std::size_t end) -> const Eigen::Vector3d& { return b_.point[b[end]]; };
    const bool are_same =
        same_way ? at_a[0] == at_b[0] && at_a[1] == at_b[1] : at_a[0] == at_b[1] && at_a[1] == at_b[0];
    if (are_same ? at_a[0] == at_a[1] : !are_across(point_a(1) - point_a(0), point_b(1) - point_b(0)))
      return false;
    for (std::size_t end_a = 0; end_a < 2; ++end_a)
      for (std::size_t end_b = 0; end_b < 2; ++end_b)
        if (at_a[end_a] == at_b[end_b]) offer(pair, a[end_a], b[end_b], sink);
    return true;
  }
  template <typename Sink>
  bool settle_vertex_and_face(const SurfacePair& pair, std::uint32_t vertex_a, std::uint32_t triangle_b,
                              const Sink& sink) {
    const std::uint32_t corner = shared_corner(a_.position[vertex_a], b_, triangle_b);
    if (corner == none) return false;
    offer(pair, vertex_a, corner, sink);
    return true;
  }
  template <typename Sink>
  bool settle_face_and_vertex(const SurfacePair& pair, std::uint32_t triangle_a, std::uint32_t vertex_b,
                              const Sink& sink) {
    const std::uint32_t corner = shared_corner(b_.position[vertex_b], a_, triangle_a);
    if (corner == none) return false;
    offer(pair, corner, vertex_b, sink);
    return true;
  }
  /// Whether an edge ends at a corner of a face's triangle. Then it does not pierce it.
  [[nodiscard]] bool ends_at_face_of_b(std::uint32_t edge_a, std::uint32_t triangle_b) const {
    return share_corner(a_, edge_a, b_, triangle_b);
  }
  [[nodiscard]] bool ends_at_face_of_a(std::uint32_t edge_b, std::uint32_t triangle_a) const {
    return share_corner(b_, edge_b, a_, triangle_a);
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.a_, self.b_, self.slots_);
  }
  void reserve(const PairRoom& room);

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// A leaf and the corners of its features, by their numbers in the leaf.
  struct Side {
    std::span<const std::uint32_t> edge_ends;
    std::span<const std::uint32_t> triangle_corners;
    bool has_quads = false;
    std::vector<std::uint32_t> vertex;
    std::vector<Eigen::Vector3d> point;
    /// A number for each position that corners of both leaves have. Any other corner has a number of its
    /// own.
    std::vector<std::uint32_t> position;
    std::vector<std::uint32_t> offered;  ///< of a: the corner of b that it was offered with last

    void begin(const Surface& surface, const Region& leaf);
    template <typename Self>
    static auto parts(Self& self) {
      return std::tie(self.vertex, self.point, self.position, self.offered);
    }
  };

  /// Whether two differences of points, rounded, are certainly not parallel: by 2^-20 at least, where
  /// rounding loses 2^-50.
  [[nodiscard]] static bool are_across(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    const double x = u.y() * v.z() - u.z() * v.y();
    const double y = u.z() * v.x() - u.x() * v.z();
    const double z = u.x() * v.y() - u.y() * v.x();
    const double sizes = u.squaredNorm() * v.squaredNorm();
    return sizes > 0x1p-900 && sizes < 0x1p900 && x * x + y * y + z * z > sizes * 0x1p-40;
  }
  /// The corner of a triangle with an area that lies at a position. A quad's triangle has none, since the
  /// quad's other one may be as near.
  [[nodiscard]] static std::uint32_t shared_corner(std::uint32_t position, const Side& side,
                                                   std::uint32_t triangle) {
    const std::uint32_t* const corner = side.triangle_corners.data() + 3 * std::size_t{triangle};
    std::size_t at = 0;
    while (at < 3 && side.position[corner[at]] != position) ++at;
    if (at == 3 || side.has_quads) return none;
    const Eigen::Vector3d& first = side.point[corner[0]];
    return are_across(side.point[corner[1]] - first, side.point[corner[2]] - first) ? corner[at] : none;
  }
  [[nodiscard]] static bool share_corner(const Side& of_edge, std::uint32_t edge, const Side& of_face,
                                         std::uint32_t triangle) {
    const std::uint32_t* const end = of_edge.edge_ends.data() + 2 * std::size_t{edge};
    const std::uint32_t* const corner = of_face.triangle_corners.data() + 3 * std::size_t{triangle};
    const std::array<std::uint32_t, 2> at{of_edge.position[end[0]], of_edge.position[end[1]]};
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t there = of_face.position[corner[i]];
      any = any || there == at[0] || there == at[1];
    }
    return any && !of_face.has_quads;
  }
  /// Offers two vertices, unless the first was offered with the second just before.
  template <typename Sink>
  void offer(const SurfacePair& pair, std::uint32_t corner_a, std::uint32_t corner_b, const Sink& sink) {
    ++pair.count.in_double;
    if (std::exchange(a_.offered[corner_a], corner_b) == corner_b) return;
    sink(FeaturePairKey::of(vertex_piece(a_.vertex[corner_a]), vertex_piece(b_.vertex[corner_b])),
         SquaredRange{0, 0});
  }

  std::uint32_t& slot_of(const Eigen::Vector3d& point);

  bool any_ = false;
  Side a_;
  Side b_;
  std::vector<std::uint32_t> slots_;  ///< corners of a by a hash of their positions
};

}  // namespace graze
