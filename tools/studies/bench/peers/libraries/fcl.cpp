#include <fcl/fcl.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>

#include "bench/peers/lazy_trees.hpp"
#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

using Model = fcl::BVHModel<fcl::AABBd>;

/// FCL: a tree of boxes, refitted from the leaves up. Distances of objects by FCL's own search, which is told
/// the range. Pairs of triangles by a walk over pairs of its nodes.
class FclTree {
 public:
  FclTree(const World& world, Task task, std::uint32_t object) : parts_(world, task, object) {
    model_.beginModel(static_cast<int>(world.objects[object].triangles.size()),
                      static_cast<int>(world.objects[object].vertex_count));
    std::vector<fcl::Vector3d> points;
    for (std::uint32_t i = 0; i < world.objects[object].vertex_count; ++i) points.push_back(point(i));
    std::vector<fcl::Triangle> triangles;
    for (const Triangle& triangle : world.objects[object].triangles)
      triangles.emplace_back(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    model_.addSubModel(points, triangles);
    model_.endModel();
  }

  void update() {
    model_.beginReplaceModel();
    const std::uint32_t count = parts_.world().objects[parts_.object()].vertex_count;
    for (std::uint32_t i = 0; i < count; ++i) model_.replaceVertex(point(i));
    model_.endReplaceModel(true, true);
  }

  void match(FclTree& other, Found& found) {
    if (parts_.task() == Task::D)
      measure(other, found);
    else
      walk(0, other, 0, found);
  }

 private:
  [[nodiscard]] fcl::Vector3d point(std::uint32_t vertex) const {
    const float* xyz = parts_.world().positions_of(parts_.object()) + 3 * std::size_t{vertex};
    return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])};
  }

  void measure(FclTree& other, Found& found) {
    const double range = parts_.world().distance;
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result(range);
    fcl::detail::MeshDistanceTraversalNode<fcl::AABBd> node;
    fcl::Transform3d here = fcl::Transform3d::Identity();
    fcl::Transform3d there = here;
    fcl::detail::initialize(node, model_, here, other.model_, there, request, result);
    fcl::detail::distance(&node);
    if (result.min_distance < range)
      found.distances.push_back(
          {parts_.object(), other.parts_.object(), result.min_distance, result.min_distance});
  }

  void walk(int here, FclTree& other, int there, Found& found) {
    const fcl::BVNode<fcl::AABBd>& a = model_.getBV(here);
    const fcl::BVNode<fcl::AABBd>& b = other.model_.getBV(there);
    const double reach = parts_.world().distance;
    for (int axis = 0; axis < 3; ++axis)
      if (a.bv.min_[axis] - b.bv.max_[axis] > reach || b.bv.min_[axis] - a.bv.max_[axis] > reach) return;
    if (a.isLeaf() && b.isLeaf())
      return parts_.test(static_cast<std::uint32_t>(a.primitiveId()), other.parts_,
                         static_cast<std::uint32_t>(b.primitiveId()), found);
    if (b.isLeaf() || (!a.isLeaf() && a.bv.size() > b.bv.size())) {
      walk(a.leftChild(), other, there, found);
      walk(a.rightChild(), other, there, found);
    } else {
      walk(here, other, b.leftChild(), found);
      walk(here, other, b.rightChild(), found);
    }
  }

  Parts parts_;
  Model model_;
};

}  // namespace

std::unique_ptr<Contender> make_fcl(const World& world, Task task, unsigned threads) {
  return std::make_unique<LazyTrees<FclTree>>(world, task, threads);
}

}  // namespace graze::bench
