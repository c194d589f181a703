#pragma once

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/leaf_front.hpp"

namespace graze {

/// The points of two surfaces that are nearest to each other, to be kept: those of `nearest`, which are
/// `point_a` and `point_b`.
LastWitness last_witness_of(const SurfacePair& pair, const FeaturePairKey& nearest,
                            const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b);

/// At least the distance of the surfaces now, by where these points are. With `vertices_only` it is the
/// distance of their vertices. Infinite where that is not known.
double upper_distance(const SurfacePair& pair, const LastWitness& witness, bool vertices_only);

}  // namespace graze
