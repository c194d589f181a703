#pragma once

#include <Eigen/Core>
#include <graze/mesh.hpp>
#include <memory>

#include "bench/rigid_bodies/rigid_contacts.hpp"
#include "rigid/body.hpp"

namespace graze::bench {

/// A rigid body's surface, for all who find contacts, and its mass. The origin is its centre of mass. Lengths
/// are in m.
struct RigidBodyShape {
  RigidShape plain;
  std::shared_ptr<const Mesh> mesh;
  rigid::MassProperties mass;
};

using RigidBodyShapePtr = std::shared_ptr<const RigidBodyShape>;

/// Returns a box of 12 triangles.
RigidBodyShapePtr box_shape(const Eigen::Vector3d& half);

/// Returns an L of 12 vertices: two bars of 50 cm, 20 cm wide and thick. It has two convex parts.
RigidBodyShapePtr l_shape();

/// Returns a ring of 160 vertices and 50 cm across, with 16 convex parts.
RigidBodyShapePtr ring_shape();

/// Returns a chess pawn of 610 vertices, 50 cm high. Its 8 convex parts have every second vertex around.
RigidBodyShapePtr pawn_shape();

}  // namespace graze::bench
