#include "bench/soft_bodies/soft_body_sources.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>

#include "examples/support/carried_point.hpp"

namespace graze::bench {
namespace {

class GrazeSource : public ContactSource {
 public:
  void find(examples::World& world, std::vector<examples::ContactConstraint>& constraints) override {
    const ReportHandle report = world.look();
    collect_constraints(*report, world.bodies(), constraints);
  }
};

std::span<const double> numbers_of(const examples::Points& points) {
  return {points.front().data(), 3 * points.size()};
}

SoftBodyView view_of(const examples::Body& body, SoftBodyKind kind) {
  SoftBodyView view{kind, numbers_of(body.positions), numbers_of(body.velocities), body.inverse_masses, {}};
  for (std::uint32_t face = 0; face < body.mesh->face_count(); ++face) {
    const auto corners = body.mesh->face(face);
    view.triangles.push_back({{corners[0], corners[1], corners[2]}});
  }
  return view;
}

/// Four vertices of a rigid body that span space. Weights of them, of which some may be below 0, carry any
/// point along with the body.
class RigidFrame {
 public:
  explicit RigidFrame(const examples::Points& points) {
    vertices_.fill(0);
    // The vertex furthest from the first, then from their line, then from the plane of all three.
    for (const std::size_t count : {1U, 2U, 3U}) vertices_[count] = furthest(points, count);
  }

  [[nodiscard]] SurfaceWeights weights(const examples::Points& points, const Eigen::Vector3d& point) const {
    Eigen::Matrix3d axes;
    for (int i = 0; i < 3; ++i)
      axes.col(i) = points[vertices_[static_cast<std::size_t>(i) + 1]] - points[vertices_[0]];
    const Eigen::Vector3d shares = axes.inverse() * (point - points[vertices_[0]]);
    return {4, vertices_, {1 - shares.sum(), shares.x(), shares.y(), shares.z()}};
  }

 private:
  [[nodiscard]] std::uint32_t furthest(const examples::Points& points, std::size_t count) const {
    std::uint32_t best = 0;
    double largest = -1;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const double distance = distance_from(points, count, points[i]);
      if (distance <= largest) continue;
      largest = distance;
      best = i;
    }
    return best;
  }
  /// The distance of a point from what the first vertices span.
  [[nodiscard]] double distance_from(const examples::Points& points, std::size_t count,
                                     const Eigen::Vector3d& point) const {
    const Eigen::Vector3d& origin = points[vertices_[0]];
    const Eigen::Vector3d way = point - origin;
    if (count == 1) return way.norm();
    const Eigen::Vector3d along = (points[vertices_[1]] - origin).normalized();
    if (count == 2) return way.cross(along).norm();
    return std::abs(way.dot(along.cross(points[vertices_[2]] - origin).normalized()));
  }

  std::array<std::uint32_t, 4> vertices_{};
};

class BulletSource : public ContactSource {
 public:
  BulletSource(std::unique_ptr<SoftContactFinder> finder, const examples::World& world)
      : finder_(std::move(finder)) {
    for (const examples::Body& body : world.bodies()) frames_.emplace_back(body.positions);
  }

  void find(examples::World& world, std::vector<examples::ContactConstraint>& constraints) override {
    finder_->find(contacts_);
    constraints.clear();
    for (const SoftContact& contact : contacts_)
      constraints.push_back(constraint_of(contact, world.bodies()));
  }

 private:
  [[nodiscard]] examples::ContactConstraint constraint_of(const SoftContact& contact,
                                                          std::deque<examples::Body>& bodies) const {
    examples::ContactConstraint constraint;
    examples::Body& a = bodies[contact.other];
    examples::Body& b = bodies[contact.body];
    constraint.a = &a;
    constraint.b = &b;
    constraint.feature_b = {FeatureKind::vertex, contact.vertex};
    constraint.weights_b = {1, {contact.vertex}, {1}};
    constraint.direction = Eigen::Map<const Eigen::Vector3d>(contact.normal);
    constraint.is_plane = contact.is_other_rigid;
    if (contact.is_other_rigid) {
      constraint.weights_a =
          frames_[contact.other].weights(a.positions, Eigen::Map<const Eigen::Vector3d>(contact.point));
    } else {
      constraint.feature_a = {FeatureKind::face, contact.face};
      const auto corners = a.mesh->face(contact.face);
      constraint.weights_a = {3,
                              {corners[0], corners[1], corners[2]},
                              {contact.weights[0], contact.weights[1], contact.weights[2]}};
    }
    constraint.separation = constraint.direction.dot(examples::carried(constraint.weights_b, b.positions) -
                                                     examples::carried(constraint.weights_a, a.positions));
    return constraint;
  }

  std::unique_ptr<SoftContactFinder> finder_;
  std::vector<RigidFrame> frames_;  ///< of all bodies, used for rigid ones
  std::vector<SoftContact> contacts_;
};

}  // namespace

std::unique_ptr<ContactSource> graze_source() {
  return std::make_unique<GrazeSource>();
}

std::unique_ptr<ContactSource> bullet_source(const PeerModule& module, examples::World& world,
                                             const std::vector<SoftBodyKind>& kinds,
                                             const SoftContactSettings& settings) {
  std::vector<SoftBodyView> views;
  for (std::size_t i = 0; i < kinds.size(); ++i) views.push_back(view_of(world.bodies()[i], kinds[i]));
  std::unique_ptr<SoftContactFinder> finder = module.soft_contact_finder(views, settings);
  if (finder == nullptr) return nullptr;
  return std::make_unique<BulletSource>(std::move(finder), world);
}

}  // namespace graze::bench
