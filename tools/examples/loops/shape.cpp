#include "examples/loops/shape.hpp"

namespace loops {

Shape rounded(const examples::Shape& shape) {
  Shape result;
  result.triangles = shape.triangles;
  for (const Eigen::Vector3d& point : shape.points) result.points.emplace_back(point.cast<float>());
  return result;
}

std::shared_ptr<const graze::Mesh> make_mesh(const Shape& shape) {
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
}

}  // namespace loops
