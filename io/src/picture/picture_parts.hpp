#pragma once

#include <Eigen/Core>
#include <array>
#include <graze/io/picture.hpp>
#include <vector>

#include "picture/raster.hpp"

namespace graze::io {

/// A triangle to draw. A quad is two, and their common diagonal is no edge.
struct PictureTriangle {
  std::array<Eigen::Vector3d, 3> points;
  std::array<Eigen::Vector3d, 3> normals;  ///< unit, smooth up to a crease
  std::array<bool, 3> is_edge;  ///< whether the side opposite to each corner is an edge of the mesh
  std::size_t object = 0;
};

/// The triangles of all faces whose corners are finite.
std::vector<PictureTriangle> list_triangles(const PictureScene& scene);

/// A perspective view. Screen z is 1 / distance along the view, so that it is linear over the screen.
struct Camera {
  Eigen::Vector3d eye;
  Eigen::Vector3d right;
  Eigen::Vector3d up;
  Eigen::Vector3d back;  ///< from the scene towards the eye
  double focal = 0;      ///< in samples
  int width = 0;         ///< in samples, as `height`
  int height = 0;
  int supersampling = 1;

  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& point) const;
  [[nodiscard]] ScreenTriangle project(const std::array<Eigen::Vector3d, 3>& points) const {
    return {project(points[0]), project(points[1]), project(points[2])};
  }
  /// From the eye through a sample's centre, 1 long along the view.
  [[nodiscard]] Eigen::Vector3d ray(int x, int y) const;
  [[nodiscard]] Eigen::Vector3d point_at(int x, int y, double z) const { return eye + ray(x, y) / z; }
};

/// A camera that sees every triangle whole. Throws InputError when there is none.
Camera frame_camera(const std::vector<PictureTriangle>& triangles, const PictureSettings& settings);

/// A depth map of the surfaces as the light sees them, to find the points in shadow.
class ShadowMap {
 public:
  ShadowMap(const std::vector<PictureTriangle>& triangles, const Camera& camera);

  [[nodiscard]] const Eigen::Vector3d& to_light() const { return back_; }
  /// From 0 in full shadow to 1 in full light, soft in between.
  [[nodiscard]] double light_at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

 private:
  static constexpr int size = 1536;
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& point) const;

  Eigen::Vector3d right_;
  Eigen::Vector3d up_;
  Eigen::Vector3d back_;
  Eigen::Vector3d centre_;
  double scale_ = 1;  ///< samples for each unit of length
  Grid<float> nearest_;
};

}  // namespace graze::io
