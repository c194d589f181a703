#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "bench/self/self_contacts.hpp"

namespace graze::bench {
namespace {

/// Bullet's deformable body against itself, without its world and its solver: vertices by faces that share no
/// corner, through a tree of faces.
class BulletSelfContacts final : public SelfContactFinder {
 public:
  BulletSelfContacts(const SelfSurface& surface, double distance) : surface_(surface) {
    std::vector<btVector3> points;
    for (std::size_t i = 0; i < surface.positions.size() / 3; ++i) points.push_back(position(i));
    soft_ = std::make_unique<btSoftBody>(&info_, static_cast<int>(points.size()), points.data(), nullptr);
    // Bullet adds the margins of two bodies, but of one it takes the margin once.
    soft_->getCollisionShape()->setMargin(static_cast<btScalar>(distance));
    add_faces();
    soft_->m_cfg.collisions = btSoftBody::fCollision::VF_DD;
    soft_->m_softSoftCollision = true;
    soft_->setSelfCollision(true);
    soft_->initializeFaceTree();
  }

  void find() override {
    for (int i = 0; i < soft_->m_nodes.size(); ++i) {
      btSoftBody::Node& node = soft_->m_nodes[i];
      node.m_x = node.m_q = position(static_cast<std::size_t>(i));
    }
    soft_->updateNormals();
    soft_->updateFaceTree(true, true);
    soft_->m_faceNodeContacts.resize(0);
    soft_->defaultCollisionHandler(soft_.get());
  }
  [[nodiscard]] std::size_t count() const override {
    return static_cast<std::size_t>(soft_->m_faceNodeContacts.size());
  }
  void list_vertices(std::vector<std::uint32_t>& vertices) const override {
    vertices.clear();
    for (int i = 0; i < soft_->m_faceNodeContacts.size(); ++i)
      vertices.push_back(
          static_cast<std::uint32_t>(soft_->m_faceNodeContacts[i].m_node - &soft_->m_nodes[0]));
  }

 private:
  /// Bullet makes its tree of vertices along links, and does not end without them.
  void add_faces() {
    std::set<std::pair<int, int>> links;
    for (const Triangle& triangle : surface_.triangles) {
      int nodes[3];
      for (int i = 0; i < 3; ++i) nodes[i] = static_cast<int>(triangle.corners[i]);
      soft_->appendFace(nodes[0], nodes[1], nodes[2]);
      for (int i = 0; i < 3; ++i) links.insert(std::minmax(nodes[i], nodes[(i + 1) % 3]));
    }
    for (const auto& [a, b] : links) soft_->appendLink(a, b);
  }

  [[nodiscard]] btVector3 position(std::size_t vertex) const {
    const double* const point = surface_.positions.data() + 3 * vertex;
    return {static_cast<btScalar>(point[0]), static_cast<btScalar>(point[1]),
            static_cast<btScalar>(point[2])};
  }

  SelfSurface surface_;
  btSoftBodyWorldInfo info_;
  std::unique_ptr<btSoftBody> soft_;
};

}  // namespace
}  // namespace graze::bench

extern "C" [[gnu::visibility("default")]] void graze_bench_self_contacts(
    const graze::bench::SelfSurface& surface, double distance,
    std::unique_ptr<graze::bench::SelfContactFinder>& finder) {
  finder = std::make_unique<graze::bench::BulletSelfContacts>(surface, distance);
}
