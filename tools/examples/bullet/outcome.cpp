#include "examples/bullet/outcome.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "support/comparison.hpp"
#include "support/oracle/oracle.hpp"

namespace examples::bullet {
namespace {

using graze::oracle::Shape;

/// A body as the oracle has it.
struct Placed {
  Shape now, rest;
  bool is_fixed = false;
  Eigen::AlignedBox3d box;
};

Placed placed(const graze::Mesh& mesh, std::vector<Eigen::Vector3d> positions) {
  Placed body;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    body.rest.faces.emplace_back(mesh.face(face).begin(), mesh.face(face).end());
  body.rest.positions.assign(mesh.rest().begin(), mesh.rest().end());
  body.now = {std::move(positions), body.rest.faces};
  for (const auto& face : body.now.faces)
    for (const std::uint32_t corner : face) body.box.extend(body.now.positions[corner]);
  return body;
}

/// All bodies in the order of the scene.
std::vector<Placed> placed(const Bodies& bodies) {
  std::vector<Placed> all;
  for (const SoftPart& part : bodies.soft()) {
    std::vector<Eigen::Vector3d> positions;
    for (int i = 0; i < part.body->m_nodes.size(); ++i)
      positions.push_back(to_eigen(part.body->m_nodes[i].m_x));
    all.push_back(placed(*part.mesh, std::move(positions)));
  }
  for (const RigidPart& part : bodies.rigid()) {
    std::vector<Eigen::Vector3d> positions;
    for (const Eigen::Vector3d& point : part.mesh->rest()) positions.push_back(pose_of(*part.body) * point);
    all.push_back(placed(*part.mesh, std::move(positions)));
    all.back().is_fixed = part.body->isStaticObject();
  }
  return all;
}

/// How far a point is from a surface: to the nearest of its triangles, by their corners, edges and insides.
double distance_to(const Shape& surface, const Eigen::Vector3d& point) {
  const Shape dot{{point, point, point}, {{0, 1, 2}}};
  return graze::oracle::surface_distance(dot, surface).distance_up;
}

}  // namespace

Through through(const Bodies& bodies) {
  const std::vector<Placed> all = placed(bodies);
  Through found;
  for (const Placed& body : all)
    for (const Placed& other : all) {
      if (&body == &other || body.is_fixed || !body.box.intersects(other.box)) continue;
      for (std::uint32_t vertex = 0; vertex < body.now.positions.size(); ++vertex) {
        const Eigen::Vector3d& point = body.now.positions[vertex];
        if (!other.box.contains(point) || !graze::oracle::winding(other.now, point).is_inside()) continue;
        ++found.vertices;
        found.deepest = std::max(found.deepest, distance_to(other.now, point));
      }
    }
  return found;
}

std::size_t compare(const GrazeWorld& world, const Bodies& bodies, std::string& difference) {
  const std::vector<Placed> all = placed(bodies);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < bodies.soft().size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const double threshold = world.contact_distance(j >= bodies.soft().size());
      if (all[i].box.exteriorDistance(all[j].box) > threshold) continue;
      const auto expected = graze::oracle::solid_pair(all[i].now, all[j].now, {true, true}, threshold,
                                                      all[i].rest, all[j].rest);
      std::span<const graze::Contact> contacts;
      for (const graze::PairReport& pair : world.report().pairs())
        if (pair.a.index == i && pair.b.index == j) contacts = world.report().contacts(pair);
      difference += graze::tests::difference_of(contacts, expected.contacts,
                                                graze::tests::Tolerance(all[i].now, all[j].now));
      compared += expected.contacts.size();
    }
  return compared;
}

}  // namespace examples::bullet
