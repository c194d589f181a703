#include "picture/picture_parts.hpp"

#include <Eigen/Geometry>
#include <graze/io/error.hpp>
#include <limits>
#include <numbers>

namespace graze::io {
namespace {

using Eigen::Vector3d;

const double crease_cosine = std::cos(40 * std::numbers::pi / 180);

/// Twice the area along the normal: a quad's is that of both its triangles.
Vector3d area_vector(const Mesh& mesh, std::uint32_t face, const std::vector<Vector3d>& positions) {
  const auto corners = mesh.face(face);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (positions[corners[i]] - positions[corners[0]])
               .cross(positions[corners[i + 1]] - positions[corners[0]]);
  return sum;
}

/// The average over the faces at `vertex` that bend away from `own` by less than a crease.
Vector3d smooth_normal(const Mesh& mesh, std::uint32_t vertex, const Vector3d& own,
                       const std::vector<Vector3d>& areas) {
  Vector3d sum = Vector3d::Zero();
  for (const std::uint32_t face : mesh.vertex_faces(vertex))
    if (areas[face].normalized().dot(own) >= crease_cosine) sum += areas[face];
  if (sum.squaredNorm() == 0) return own;
  return sum.normalized();
}

void list_object(const PictureScene::Object& object, std::size_t index,
                 std::vector<PictureTriangle>& triangles) {
  const Mesh& mesh = *object.mesh;
  std::vector<Vector3d> areas(mesh.face_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    areas[face] = area_vector(mesh, face, object.positions);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const auto corners = mesh.face(face);
    const Vector3d own = areas[face].normalized();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      const std::array<std::uint32_t, 3> used{corners[0], corners[i], corners[i + 1]};
      PictureTriangle triangle;
      triangle.object = index;
      triangle.is_edge = {true, i + 2 == corners.size(), i == 1};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle.points[corner] = object.positions[used[corner]];
        triangle.normals[corner] = smooth_normal(mesh, used[corner], own, areas);
      }
      if ((triangle.points[0] + triangle.points[1] + triangle.points[2]).allFinite())
        triangles.push_back(triangle);
    }
  }
}

/// Two directions that are level and upright to an eye that looks along -back.
void set_axes(const Vector3d& back, Vector3d& right, Vector3d& up) {
  const Vector3d world_up = std::abs(back.z()) < 0.999 ? Vector3d::UnitZ() : Vector3d::UnitY();
  right = world_up.cross(back).normalized();
  up = back.cross(right);
}

}  // namespace

std::vector<PictureTriangle> list_triangles(const PictureScene& scene) {
  std::vector<PictureTriangle> triangles;
  for (std::size_t index = 0; index < scene.objects.size(); ++index)
    list_object(scene.objects[index], index, triangles);
  return triangles;
}

Vector3d Camera::project(const Vector3d& point) const {
  const Vector3d offset = point - eye;
  const double away = -back.dot(offset);
  return {0.5 * width + focal * right.dot(offset) / away, 0.5 * height - focal * up.dot(offset) / away,
          1 / away};
}

Vector3d Camera::ray(int x, int y) const {
  return right * ((x + 0.5 - 0.5 * width) / focal) - up * ((y + 0.5 - 0.5 * height) / focal) - back;
}

Camera frame_camera(const std::vector<PictureTriangle>& triangles, const PictureSettings& settings) {
  if (triangles.empty()) throw InputError("the picture: no face has finite corners; choose another frame");
  constexpr double half_height = 0.26;  // tangent of half the angle of view
  constexpr double used_part = 0.86;    // of the frame
  Camera camera;
  camera.supersampling = settings.supersampling;
  camera.width = settings.width * settings.supersampling;
  camera.height = settings.height * settings.supersampling;
  camera.focal = 0.5 * camera.height / half_height;
  camera.back = settings.to_camera.normalized();
  set_axes(camera.back, camera.right, camera.up);
  // The sides of the view are four planes through the eye: the eye is where the tightest of each pair meet,
  // moved back until both pairs fit.
  const double tan_y = half_height * used_part;
  const double tan_x = tan_y * settings.width / settings.height;
  double left = std::numeric_limits<double>::infinity();
  double right = -left, low = left, high = -left;
  for (const PictureTriangle& triangle : triangles)
    for (const Vector3d& point : triangle.points) {
      const double x = camera.right.dot(point), y = camera.up.dot(point), z = camera.back.dot(point);
      left = std::min(left, x - tan_x * z);
      right = std::max(right, x + tan_x * z);
      low = std::min(low, y - tan_y * z);
      high = std::max(high, y + tan_y * z);
    }
  const double away = std::max((right - left) / (2 * tan_x), (high - low) / (2 * tan_y));
  camera.eye = camera.right * (0.5 * (left + right)) + camera.up * (0.5 * (low + high)) + camera.back * away;
  return camera;
}

ShadowMap::ShadowMap(const std::vector<PictureTriangle>& triangles, const Camera& camera)
    : back_((0.9 * camera.back - 0.55 * camera.right + Vector3d(0, 0, 1.5)).normalized()),
      nearest_(size, size, -std::numeric_limits<float>::infinity()) {
  set_axes(back_, right_, up_);
  Eigen::AlignedBox3d box;
  for (const PictureTriangle& triangle : triangles)
    for (const Vector3d& point : triangle.points) box.extend(point);
  centre_ = 0.5 * (box.min() + box.max());
  scale_ = 0.95 * size / std::max((box.max() - box.min()).norm(), std::numeric_limits<double>::min());
  for (const PictureTriangle& triangle : triangles) {
    const ScreenTriangle corners{project(triangle.points[0]), project(triangle.points[1]),
                                 project(triangle.points[2])};
    for_each_sample(corners, size, size, [&](int x, int y, const Vector3d& weights) {
      const double z =
          weights[0] * corners[0].z() + weights[1] * corners[1].z() + weights[2] * corners[2].z();
      nearest_.at(x, y) = std::max(nearest_.at(x, y), static_cast<float>(z));
    });
  }
}

Vector3d ShadowMap::project(const Vector3d& point) const {
  const Vector3d offset = scale_ * (point - centre_);
  return {0.5 * size + right_.dot(offset), 0.5 * size - up_.dot(offset), back_.dot(offset)};
}

double ShadowMap::light_at(const Vector3d& point, const Vector3d& normal) const {
  constexpr int reach = 3;    // samples either way
  constexpr double bias = 2;  // samples off the surface, so that it does not shade itself
  const Vector3d seen = project(point + normal * (bias / scale_));
  const double slack = 1.5 + bias;
  int lit = 0, count = 0;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx, ++count) {
      const int x = static_cast<int>(std::clamp(seen.x() + dx, -1.0, double{size}));
      const int y = static_cast<int>(std::clamp(seen.y() + dy, -1.0, double{size}));
      if (!nearest_.contains(x, y) || seen.z() + slack >= static_cast<double>(nearest_.at(x, y))) ++lit;
    }
  return static_cast<double>(lit) / count;
}

}  // namespace graze::io
