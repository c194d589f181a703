#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "examples/loops/shape.hpp"

namespace loops {

/// One rigid body that contacts move.
struct Prop {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, of its centre
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();             ///< m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                 ///< rad/s
  double inverse_mass = 0;                                        ///< 1/kg
  Eigen::Vector3d inverse_inertia = Eigen::Vector3d::Zero();      ///< 1/(kg m²), about its own axes
  Eigen::Matrix3d inverse_inertia_now = Eigen::Matrix3d::Zero();  ///< the same about the axes of the world
  std::size_t shape = 0;

  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& arm) const {
    return velocity + spin.cross(arm);
  }
  void push(const Eigen::Vector3d& arm, const Eigen::Vector3d& impulse);
};

/// All props: crates, planks and balls. Their poses are what Scene::set_poses() takes.
class Props {
 public:
  explicit Props(std::size_t count);

  /// Moves all props by their velocities for a time in seconds. Then gravity pulls. The contacts that graze
  /// finds now take back what of that would lead through a surface.
  void move(double time);
  /// Stops what hardly moves. A prop that stands still costs graze nothing: its pose is the one of before.
  void rest();

  [[nodiscard]] std::vector<Prop>& props() { return props_; }
  [[nodiscard]] const std::vector<Eigen::Isometry3d>& poses() const { return poses_; }
  [[nodiscard]] const std::shared_ptr<const graze::Mesh>& mesh(std::size_t index) const {
    return meshes_[props_[index].shape];
  }

 private:
  void update_pose(std::size_t index);

  std::vector<std::shared_ptr<const graze::Mesh>> meshes_;
  std::vector<Prop> props_;
  std::vector<Eigen::Isometry3d> poses_;
};

}  // namespace loops
