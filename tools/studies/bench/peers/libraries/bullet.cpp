#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/Gimpact/btGImpactBvh.h>

#include "bench/peers/lazy_trees.hpp"
#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

btVector3 vector_of(const float (&point)[3]) {
  return {point[0], point[1], point[2]};
}

/// Bullet's dynamic tree, a leaf for each vertex. Volumes are refitted from the leaves up.
class DynamicTree {
 public:
  DynamicTree(const World& world, Task task, std::uint32_t object) : parts_(world, task, object) {
    for (std::uint32_t part = 0; part < parts_.count(); ++part) {
      btDbvtNode* const leaf = tree_.insert(volume_of(part), nullptr);
      leaf->dataAsInt = static_cast<int>(part);
    }
    tree_.optimizeTopDown();
  }

  void update() { refit(tree_.m_root); }

  void match(DynamicTree& other, Found& found) {
    Matches matches(parts_, other.parts_, found);
    tree_.collideTT(tree_.m_root, other.tree_.m_root, matches);
  }

 private:
  struct Matches : btDbvt::ICollide {
    Matches(const Parts& of_this, const Parts& of_other, Found& of_both)
        : parts(of_this), other(of_other), found(of_both) {}
    void Process(const btDbvtNode* a, const btDbvtNode* b) override {
      parts.test(static_cast<std::uint32_t>(a->dataAsInt), other, static_cast<std::uint32_t>(b->dataAsInt),
                 found);
    }
    const Parts& parts;
    const Parts& other;
    Found& found;
  };

  [[nodiscard]] btDbvtVolume volume_of(std::uint32_t part) const {
    const FloatBox box = parts_.grown_box(part);
    return btDbvtVolume::FromMM(vector_of(box.min), vector_of(box.max));
  }
  void refit(btDbvtNode* node) const {
    if (node->isleaf()) {
      node->volume = volume_of(static_cast<std::uint32_t>(node->dataAsInt));
      return;
    }
    refit(node->childs[0]);
    refit(node->childs[1]);
    Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume);
  }

  Parts parts_;
  btDbvt tree_;
};

/// GImpact's tree of triangles, refitted.
class ImpactTree {
 public:
  ImpactTree(const World& world, Task task, std::uint32_t object)
      : primitives_(Parts(world, task, object)), tree_(&primitives_) {
    tree_.buildSet();
  }

  void update() { tree_.update(); }

  void match(ImpactTree& other, Found& found) {
    btPairSet pairs;
    btGImpactBvh::find_collision(&tree_, btTransform::getIdentity(), &other.tree_, btTransform::getIdentity(),
                                 pairs);
    for (int i = 0; i < pairs.size(); ++i)
      primitives_.parts.test(static_cast<std::uint32_t>(pairs[i].m_index1), other.primitives_.parts,
                             static_cast<std::uint32_t>(pairs[i].m_index2), found);
  }

 private:
  struct Primitives : btPrimitiveManagerBase {
    explicit Primitives(const Parts& of_object) : parts(of_object) {}
    bool is_trimesh() const override { return true; }
    int get_primitive_count() const override { return static_cast<int>(parts.count()); }
    void get_primitive_box(int part, btAABB& result) const override {
      const FloatBox box = parts.grown_box(static_cast<std::uint32_t>(part));
      result.m_min = vector_of(box.min);
      result.m_max = vector_of(box.max);
    }
    void get_primitive_triangle(int, btPrimitiveTriangle&) const override {}  // nobody asks a tree for them

    Parts parts;
  };

  Primitives primitives_;
  btGImpactBvh tree_;
};

}  // namespace

std::unique_ptr<Contender> make_bullet(const World& world, Task task, unsigned threads) {
  if (task == Task::A) return std::make_unique<LazyTrees<DynamicTree>>(world, task, threads);
  return std::make_unique<LazyTrees<ImpactTree>>(world, task, threads);
}

}  // namespace graze::bench
