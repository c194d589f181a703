#include <algorithm>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "bench/peers/lazy_trees.hpp"
#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

/// A set of points with the functions that nanoflann requires.
struct Cloud {
  const float* points;
  std::size_t count;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return count; }
  [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[3 * index + axis];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// nanoflann: a tree of the vertices, rebuilt when it is first asked for in a frame. The vertices of the
/// later object that are in this one's box look for their neighbours. In float, a little wider than the
/// distance.
class PointTree {
 public:
  PointTree(const World& world, Task task, std::uint32_t object)
      : parts_(world, task, object),
        cloud_{world.positions_of(object), parts_.count()},
        tree_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size)) {
    update();
  }

  void update() {
    tree_.buildIndex();
    box_ = grown(box_of(cloud_.points, cloud_.count), parts_.world().distance);
  }

  void match(PointTree& other, Found& found) const {
    thread_local PointList inside;
    thread_local std::vector<std::pair<std::uint32_t, float>> near;
    inside.clear();
    add_inside(other.cloud_.points, 0, other.cloud_.count, box_, inside);
    const float limit = square_above(parts_.world().distance);
    nanoflann::SearchParams parameters;
    parameters.sorted = false;
    for (std::size_t i = 0; i < inside.count; ++i) {
      const float point[3] = {inside.x[i], inside.y[i], inside.z[i]};
      near.clear();
      tree_.radiusSearch(point, limit, near, parameters);
      for (const auto& [vertex, squared] : near) parts_.test(vertex, other.parts_, inside.index[i], found);
    }
  }

 private:
  static constexpr std::size_t leaf_size = 16;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3,
                                                   std::uint32_t>;

  Parts parts_;
  Cloud cloud_;
  Tree tree_;
  FloatBox box_;
};

}  // namespace

std::unique_ptr<Contender> make_nanoflann(const World& world, Task task, unsigned threads) {
  return std::make_unique<LazyTrees<PointTree>>(world, task, threads);
}

}  // namespace graze::bench
