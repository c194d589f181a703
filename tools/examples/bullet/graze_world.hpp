#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/bullet/bodies.hpp"
#include "examples/bullet/contacts.hpp"

namespace examples::bullet {

/// Bullet's world with graze in place of its detection for soft bodies. Bullet still solves all contacts.
class GrazeWorld : public World {
 public:
  using World::World;

  /// Takes contacts from graze from now on. The scene reads Bullet's nodes where they lie. So the bodies must
  /// get no more nodes, and must outlive the last step.
  void attach(const Bodies& bodies, double time_step);

  [[nodiscard]] graze::Scene& scene() { return *scene_; }
  [[nodiscard]] const graze::FrameReport& report() const { return *report_; }
  /// Returns the distance in metres below which a soft body has contacts with others.
  [[nodiscard]] double contact_distance(bool with_rigid) const {
    return (with_rigid ? 1 : 2) * bodies_->margin() + reach_;
  }

 protected:
  void find_rigid_contacts(btScalar time_step) override;
  void find_soft_contacts(btScalar time_step) override;
  void stop_crossings(btScalar time_step) override;

 private:
  void add_rigid(const graze::PairReport& pair, const graze::Contact& contact, btScalar time_step);
  void add_soft(const graze::PairReport& pair, const graze::Contact& contact, btScalar time_step);
  [[nodiscard]] SoftPoint point_of(std::uint64_t soft, const graze::Feature& feature,
                                   const Eigen::Vector3d& point) const;
  [[nodiscard]] bool is_crossing(btScalar time_step) const;

  double reach_ = 0;  ///< m, how far two bodies approach each other in a step
  std::unique_ptr<graze::Scene> scene_;
  graze::ReportHandle report_;
  const Bodies* bodies_ = nullptr;
  std::vector<FaceOfFeature> faces_;  ///< of each soft body
  graze::ObjectId paddle_;
};

}  // namespace examples::bullet
