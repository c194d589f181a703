#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <memory>
#include <string_view>
#include <vector>

namespace graze::bench {

/// One surface and the way it takes: its rest shape is turned once, moved along a Lissajous path about
/// `centre`, and wobbles radially.
struct Body {
  std::shared_ptr<const Mesh> mesh;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d path = Eigen::Vector3d::Zero();   ///< amplitude along each axis
  Eigen::Vector3d speed = Eigen::Vector3d::Zero();  ///< radians a frame
  double phase = 0;
};

/// A scene that is the same in every run: positions are functions of the frame alone.
struct BenchScene {
  std::string_view name;
  double distance = 0;  ///< threshold and range
  std::size_t frames = 0;
  double wobble = 0;  ///< relative to the radius
  std::vector<Body> bodies;
};

/// All scenes' names.
std::vector<std::string_view> scene_names();

/// The scene of a name; none of its bodies where there is none.
BenchScene make_scene(std::string_view name);

/// Where the vertices of a body are in `frame`.
void place(const BenchScene& scene, const Body& body, std::size_t frame,
           std::vector<Eigen::Vector3f>& positions);

}  // namespace graze::bench
