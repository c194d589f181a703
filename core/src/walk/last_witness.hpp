#pragma once

#include "core/pair/leaf_front.hpp"
#include "names/contact_name.hpp"

namespace graze {

/// The points of two surfaces that are nearest to each other, to be kept: those of `nearest`, which are
/// `point_a` and `point_b`.
LastWitness last_witness_of(const SurfacePair& pair, const ContactName& nearest,
                            const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b);

/// At least the distance of the surfaces now, by where these points are; of their vertices with
/// `vertices_only`. Infinite where that is not known.
double upper_distance(const SurfacePair& pair, const LastWitness& witness, bool vertices_only);

}  // namespace graze
