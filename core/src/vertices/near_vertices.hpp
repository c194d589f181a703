#pragma once

#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/surface/surface.hpp"
#include "pair/near_listing.hpp"
#include "vertices/block_boxes.hpp"
#include "vertices/near_part.hpp"
#include "walk/closest_range.hpp"
#include "walk/dmv.hpp"

namespace graze {

/// The blocks of two surfaces that may be near the other surface, for all slices of a search. Boxes are
/// relative to the origin of b's.
struct NearBlocks {
  /// The blocks themselves, of a surface that has stretches instead.
  NearPart part_a;
  NearPart part_b;
  IndexList a;  ///< ascending
  IndexList b;
  /// Whether b has so few blocks left that they are tested in a line, by their index in the list. If there
  /// are more, all levels are used, and blocks have their index among all blocks of b.
  bool is_linear_scan = false;
  BoxRows boxes;  ///< of the few
  // The points of each block of b at its index, in one of the two.
  std::vector<float> floats;
  std::vector<double> doubles;
  Eigen::Vector3f shift;  ///< from the origin of a's
  float reach =
      0;  ///< points no nearer than this along an axis, in float, are certainly not within the limit

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.part_a, self.part_b, self.a, self.b, self.boxes, self.floats, self.doubles);
  }
  void reserve(const PairRoom& room);
};

/// Working memory of one thread.
struct NearVerticesScratch {
  IndexList groups;
  IndexList around;                                          ///< indices of blocks of b near some blocks of a
  BoxRows boxes;                                             ///< of these
  IndexList beside;                                          ///< of these those near one of them
  IndexList near_a;                                          ///< points of a block of a
  IndexList near_b;                                          ///< and of those beside it
  std::vector<std::pair<double, std::uint32_t>> near_first;  ///< how far they are at least, blocks of a

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.groups, self.around, self.boxes, self.beside, self.near_a, self.near_b,
                    self.near_first);
  }
  void reserve(const PairRoom& room);
};

/// Finds all pairs of vertices that are nearer than a limit, from the blocks of both surfaces. It goes from
/// blocks in each other's box to those whose boxes are near each other, and from these to the points.
class NearVertices {
 public:
  /// Both surfaces have their blocks, or stretches.
  NearVertices(const SurfacePair& pair, double limit, NearBlocks& near, NearVerticesScratch& scratch);

  /// Lists the blocks that may have such a pair. It lists none of a where there is none.
  void find_blocks();
  /// Appends the pairs of some of the listed blocks of a that are nearer than a threshold, in their order, by
  /// the points of a and then of b. Lists all pairs that are not certainly further than the limit. Returns
  /// false when the budget ran out. Reads the lists of blocks alone, so that several threads may call it at
  /// once.
  bool append_near(std::size_t begin, std::size_t end, double threshold, WorkMeter& meter,
                   std::vector<FeaturePairKey>& keys, const NearListing& listing);
  /// Offers the nearest pairs of all listed blocks, and those met before them. Returns false when the budget
  /// ran out. Does not search where pairs would be of no use beside the nearest so far.
  bool offer(WorkMeter& meter, ClosestRange& nearest);

 private:
  [[nodiscard]] bool make_parts();
  void set_limit(double limit);
  void tighten();
  void lay_out_blocks_of_b();
  void order_near_first();
  [[nodiscard]] kernels::BoxInFrame box_around(std::uint32_t block_of_a) const;
  bool find_around(std::span<const std::uint32_t> blocks_of_a);
  void find_beside(std::uint32_t block_of_a);
  void find_beside_in_around(std::uint32_t block_of_a);
  template <typename Number>
  [[nodiscard]] double upper_distance_beside(std::uint32_t block_of_a,
                                             const std::vector<Number>& blocks_of_b) const;
  template <typename Number>
  std::size_t compare(std::uint32_t block_of_a, std::span<const std::uint32_t> beside,
                      const std::vector<Number>& blocks_of_b);
  /// Calls `visit(key)` for all pairs of a block of a and those found beside it that are not certainly too
  /// far.
  template <typename Visit>
  void for_each_near(std::uint32_t block_of_a, const Visit& visit);

  const SurfacePair& pair_;
  const VertexBlocks& of_a_;
  const VertexBlocks& of_b_;
  double limit_;
  bool in_float_;
  NearBlocks& near_;
  NearVerticesScratch& scratch_;
};

}  // namespace graze
