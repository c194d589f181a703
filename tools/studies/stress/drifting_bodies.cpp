#include "stress/drifting_bodies.hpp"

#include <cmath>
#include <utility>

#include "models/models.hpp"
#include "scenes/random.hpp"

namespace graze::tools {
namespace {

std::shared_ptr<const Mesh> sphere(std::uint32_t segments, std::uint32_t rings) {
  const models::MeshData data = models::sphere(segments, rings);
  return std::make_shared<const Mesh>(
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts)));
}

}  // namespace

DriftingBodies::DriftingBodies(std::shared_ptr<const Mesh> mesh, std::vector<Body> bodies, double wobble,
                               double drift, double distance)
    : mesh_(std::move(mesh)), bodies_(std::move(bodies)), wobble_(wobble), drift_(drift) {
  settings_.contact_distance = settings_.range = distance;
  settings_.detail = ContactDetail::features;
  for (const Eigen::Vector3d& rest : mesh_->rest())
    waves_.emplace_back(std::sin(5 * rest.z()), std::cos(5 * rest.z()));
  positions_.resize(bodies_.size() * mesh_->vertex_count() * 3);
  move(0);
}

DriftingBodies DriftingBodies::lattice(std::size_t count) {
  return lattice(count, 2.55);
}

DriftingBodies DriftingBodies::sparse_lattice(std::size_t count) {
  return lattice(count, 3.2);
}

DriftingBodies DriftingBodies::lattice(std::size_t count, double spacing) {
  constexpr double jitter = 0.3;
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  scenes::Random random(5);
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / side % side;
    const std::size_t layer = i / side / side;
    const Eigen::Vector3d cell(static_cast<double>(i % side), static_cast<double>(row),
                               static_cast<double>(layer));
    const Eigen::Vector3d centre = spacing * cell + random.vector(-jitter, jitter);
    bodies.push_back({centre, random.between(0, 6)});
  }
  return {sphere(16, 16), std::move(bodies), 0.02, 0.02, 0.04};
}

DriftingBodies DriftingBodies::large_pair() {
  return {sphere(400, 250), {{{-0.999, 0, 0}, 0}, {{0.999, 0, 0}, 2}}, 0.006, 0.002, 0.02};
}

DriftingBodies DriftingBodies::heap(std::size_t count) {
  constexpr double spacing = 1.95;
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d cell(static_cast<double>(i % side), static_cast<double>(i / side % side),
                               static_cast<double>(i / side / side));
    bodies.push_back({spacing * cell, static_cast<double>(i % 7)});
  }
  return {sphere(32, 25), std::move(bodies), 0.02, 0.02, 0.04};
}

DriftingBodies DriftingBodies::entangled_pair() {
  return {sphere(100, 100), {{{0, 0, 0}, 0}, {{0.01, 0, 0}, 2}}, 0.01, 0.002, 0.01};
}

std::vector<ObjectId> DriftingBodies::add_unbound_to(Scene& scene) const {
  std::vector<ObjectId> ids;
  for (std::size_t i = 0; i < bodies_.size(); ++i) ids.push_back(scene.add(mesh_));
  return ids;
}

void DriftingBodies::add_to(Scene& scene) const {
  const std::vector<ObjectId> ids = add_unbound_to(scene);
  for (std::size_t i = 0; i < ids.size(); ++i) scene.bind_positions(ids[i], positions_of(i));
}

void DriftingBodies::move(std::size_t frame) {
  const auto time = static_cast<double>(frame);
  float* out = positions_.data();
  const auto rest = mesh_->rest();
  for (const Body& body : bodies_) {
    Eigen::Vector3d centre = body.centre;
    for (int axis = 0; axis < 3; ++axis)
      centre[axis] += drift_ * std::sin((0.1 + 0.03 * axis) * time + body.phase);
    const Eigen::Vector2f turn(std::cos(0.3 * time + body.phase), std::sin(0.3 * time + body.phase));
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const double swell = 1 + wobble_ * static_cast<double>(waves_[i].dot(turn));
      for (int axis = 0; axis < 3; ++axis) *out++ = static_cast<float>(centre[axis] + swell * rest[i][axis]);
    }
  }
}

float DriftingBodies::read() const {
  // Sixteen sums, so that the memory is what it waits for.
  using Row = Eigen::Array<float, 16, 1>;
  Row sums = Row::Zero();
  const std::size_t whole = positions_.size() / 16 * 16;
  for (std::size_t i = 0; i < whole; i += 16) sums += Eigen::Map<const Row>(positions_.data() + i);
  float sum = sums.sum();
  for (std::size_t i = whole; i < positions_.size(); ++i) sum += positions_[i];
  return sum;
}

}  // namespace graze::tools
