#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/mesh.hpp>
#include <memory>
#include <vector>

#include "accuracy/moving_surfaces.hpp"
#include "support/oracle/oracle.hpp"

namespace graze::tools {

/// The paper's five models, each bending, twisting and turning, which meet in the middle and part again:
/// apart, near, touching and interpenetrating in the course of `frame_count` frames.
class MovingModels final : public MovingSurfaces {
 public:
  MovingModels(std::uint64_t seed, std::uint32_t frame_count);

  [[nodiscard]] std::size_t size() const override { return bodies_.size(); }
  [[nodiscard]] std::uint32_t frame_count() const override { return frame_count_; }
  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh(std::size_t body) const override {
    return bodies_[body].mesh;
  }
  [[nodiscard]] double mean_edge_length() const override { return mean_edge_length_; }
  [[nodiscard]] const std::vector<double>& level_epsilon() const override { return level_epsilon_; }
  void place(Scene& scene, ObjectId object, std::size_t body, std::uint32_t frame) const override;

  [[nodiscard]] std::vector<Eigen::Vector3d> positions(std::size_t index, std::uint32_t frame) const;
  /// The surface as the oracle takes it.
  [[nodiscard]] oracle::Shape shape(std::size_t body, std::uint32_t frame) const;
  [[nodiscard]] const oracle::Shape& rest(std::size_t body) const { return bodies_[body].rest; }

 private:
  struct Body {
    oracle::Shape rest;
    std::shared_ptr<const Mesh> mesh;
    Eigen::Vector3d way;   ///< from the middle outward
    Eigen::Vector3d axis;  ///< of turning
    double turn = 0;       ///< from the first frame to the last
    double bend = 0;
    double twist = 0;
  };

  std::uint32_t frame_count_;
  std::vector<Body> bodies_;
  double mean_edge_length_ = 0;
  std::vector<double> level_epsilon_;
};

}  // namespace graze::tools
