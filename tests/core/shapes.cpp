#include "core/shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <utility>

#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

struct Extent {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d max = -min;
};

Extent extent_of(const oracle::Shape& shape) {
  Extent extent;
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) {
      extent.min = extent.min.cwiseMin(shape.positions[corner]);
      extent.max = extent.max.cwiseMax(shape.positions[corner]);
    }
  return extent;
}

}  // namespace

oracle::Shape mapped(oracle::Shape shape, double factor, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& position : shape.positions) position = factor * position + offset;
  return shape;
}

oracle::Shape snapped(oracle::Shape shape, double step) {
  for (Eigen::Vector3d& position : shape.positions)
    for (double& coordinate : position) coordinate = step * std::round(coordinate / step);
  return shape;
}

oracle::Shape wobbled(oracle::Shape shape, double size, std::uint64_t seed) {
  oracle::Random random(seed);
  for (int wave = 0; wave < 3; ++wave) {
    const Eigen::Vector3d direction = random.vector(-4, 4);
    const double phase = random.between(0, 6);
    for (Eigen::Vector3d& position : shape.positions)
      position[wave] += size * std::sin(direction.dot(position) + phase);
  }
  return shape;
}

oracle::Shape turned(oracle::Shape shape, std::uint64_t seed) {
  oracle::Random random(seed);
  const Eigen::Vector3d angles = random.vector(0, 6);
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  for (Eigen::Vector3d& position : shape.positions) position = turn * Eigen::Vector3d(position);
  return shape;
}

oracle::Shape placed_beside(oracle::Shape shape, const oracle::Shape& other, int axis, double gap) {
  const double offset = extent_of(other).max[axis] + gap - extent_of(shape).min[axis];
  return mapped(std::move(shape), 1, Eigen::Vector3d::Unit(axis) * offset);
}

oracle::Shape random_soup(std::uint64_t seed, std::uint32_t vertex_count, std::uint32_t face_count) {
  oracle::Random random(seed);
  const bool on_grid = seed % 2 == 1;
  const auto coordinate = [&] { return on_grid ? 0.25 * random.below(5) : random.between(0, 1); };
  oracle::Shape shape;
  for (std::uint32_t face = 0; face < face_count; ++face) {
    std::vector<std::uint32_t> corners(3 + random.below(2));
    for (std::uint32_t& corner : corners) corner = random.below(vertex_count);
    shape.faces.push_back(corners);
  }
  std::vector<bool> used(vertex_count, false);
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) used[corner] = true;
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    const double x = coordinate();
    const double y = coordinate();
    shape.positions.emplace_back(x, y, coordinate());
    if (!used[vertex]) shape.positions.back().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return shape;
}

oracle::Shape triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
  return {{p, q, r}, {{0, 1, 2}}};
}

oracle::Shape quad(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                   const Eigen::Vector3d& s) {
  return {{p, q, r, s}, {{0, 1, 2, 3}}};
}

oracle::Shape box(const Eigen::Vector3d& low, const Eigen::Vector3d& size) {
  oracle::Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.positions.emplace_back(low + size.cwiseProduct(Eigen::Vector3d(i & 1U, (i >> 1U) & 1U, i >> 2U)));
  shape.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return shape;
}

const std::vector<NamedShape>& paper_models() {
  static const std::vector<NamedShape> all{{"torus", shape_of(models::torus())},
                                           {"pawn", shape_of(models::pawn())},
                                           {"cylinder", shape_of(models::cylinder())},
                                           {"human", shape_of(models::human())},
                                           {"tooth", shape_of(models::tooth())}};
  return all;
}

const std::vector<NamedShape>& paper_models_of_quads() {
  using models::Faces;
  static const std::vector<NamedShape> all{{"torus of quads", shape_of(models::torus(Faces::quads))},
                                           {"pawn of quads", shape_of(models::pawn(Faces::quads))},
                                           {"cylinder of quads", shape_of(models::cylinder(Faces::quads))}};
  return all;
}

}  // namespace graze::tests
