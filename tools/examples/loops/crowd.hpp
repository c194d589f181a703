#pragma once

#include <cstdint>
#include <vector>

#include "examples/loops/shape.hpp"

namespace loops {

/// One character. It walks to a goal, and bends as it walks. Nothing pushes it.
struct Character {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();   ///< m
  Eigen::Vector2d dodge = Eigen::Vector2d::Zero();  ///< m/s, out of the way of other characters
  double heading = 0;                               ///< rad
  double phase = 0;                                 ///< of its step, in rad
  double step_height = 0;                           ///< how much it stretches in a step. It follows `touches`
  int touches = 0;                                  ///< how many props touch it now
  std::uint32_t goals = 0;                          ///< how many goals it has had
  std::vector<Eigen::Vector3f> points;              ///< graze reads them in each step
  std::vector<Eigen::Vector3f> before;              ///< the points of the frame before
  std::vector<Eigen::Vector3f> normals;             ///< for drawing
};

/// All characters. They share a mesh of 502 vertices.
class Crowd {
 public:
  explicit Crowd(std::size_t count);

  /// Walks for a time in seconds, and writes all points. No step of graze may run meanwhile.
  void animate(double time);
  /// Turns characters to their goals, and gives new goals. It writes no points, so a step may run meanwhile.
  void steer(double time);
  /// Decides how characters get out of each other's way. A step may run meanwhile.
  void dodge();
  /// Computes the normals that a renderer wants. It reads the points, so a step may run meanwhile.
  void compute_normals();
  /// Gives a character another goal.
  void turn_away(std::size_t index);

  /// Returns the velocity of a point on the surface of a character, in m/s.
  [[nodiscard]] Eigen::Vector3d velocity_at(std::size_t index, const graze::Feature& feature,
                                            const Eigen::Vector3d& point, double time) const;

  [[nodiscard]] const std::shared_ptr<const graze::Mesh>& mesh() const { return mesh_; }
  [[nodiscard]] std::vector<Character>& characters() { return characters_; }

 private:
  void pose(Character& character) const;

  Shape rest_;
  std::shared_ptr<const graze::Mesh> mesh_;
  std::vector<Character> characters_;
};

}  // namespace loops
