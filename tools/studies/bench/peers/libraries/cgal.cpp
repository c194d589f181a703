#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

#include "bench/peers/lazy_trees.hpp"
#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
using Tree = CGAL::AABB_tree<Traits>;

CGAL::Bbox_3 bbox_of(const FloatBox& box) {
  return {static_cast<double>(box.min[0]), static_cast<double>(box.min[1]), static_cast<double>(box.min[2]),
          static_cast<double>(box.max[0]), static_cast<double>(box.max[1]), static_cast<double>(box.max[2])};
}

/// CGAL: a tree of triangles, rebuilt. The other object's triangles near its box look for those whose boxes
/// theirs meet.
class CgalTree {
 public:
  CgalTree(const World& world, Task task, std::uint32_t object) : parts_(world, task, object) { update(); }

  void update() {
    triangles_.clear();
    const float* positions = parts_.world().positions_of(parts_.object());
    const auto point = [&](std::uint32_t vertex) {
      const float* xyz = positions + 3 * std::size_t{vertex};
      return Kernel::Point_3(static_cast<double>(xyz[0]), static_cast<double>(xyz[1]),
                             static_cast<double>(xyz[2]));
    };
    for (const Triangle& triangle : parts_.world().objects[parts_.object()].triangles)
      triangles_.emplace_back(point(triangle.corners[0]), point(triangle.corners[1]),
                              point(triangle.corners[2]));
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
    tree_.build();
  }

  void match(CgalTree& other, Found& found) {
    const CGAL::Bbox_3 around = tree_.bbox();
    for (std::uint32_t part = 0; part < other.parts_.count(); ++part) {
      const CGAL::Bbox_3 box = bbox_of(grown(other.parts_.box(part), parts_.world().distance));
      if (!CGAL::do_overlap(box, around)) continue;
      Walk walk{*this, other, part, found};
      tree_.traversal(box, walk);
    }
  }

 private:
  struct Walk {
    CgalTree& tree;
    CgalTree& other;
    std::uint32_t part;
    Found& found;

    [[nodiscard]] bool go_further() const { return true; }
    [[nodiscard]] bool do_intersect(const CGAL::Bbox_3& box, const CGAL::AABB_node<Traits>& node) const {
      return CGAL::do_overlap(box, node.bbox());
    }
    void intersection(const CGAL::Bbox_3&, const Primitive& primitive) {
      tree.parts_.test(static_cast<std::uint32_t>(primitive.id() - tree.triangles_.cbegin()), other.parts_,
                       part, found);
    }
  };

  Parts parts_;
  Triangles triangles_;
  Tree tree_;
};

}  // namespace

std::unique_ptr<Contender> make_cgal(const World& world, Task task, unsigned threads) {
  return std::make_unique<LazyTrees<CgalTree>>(world, task, threads);
}

}  // namespace graze::bench
