#pragma once

#include <graze/contact.hpp>

#include "closest_features/feature_pair_key.hpp"

namespace graze {

/// The contact of a key that meets in one point pair: points, distance, normal and sides.
Contact measure(const SurfacePair& pair, const FeaturePairKey& key);
/// As `measure`, but without the sides, which contacts at distance 0 have none of.
Contact measure_without_sides(const SurfacePair& pair, const FeaturePairKey& key);

/// The contact of parallel features, at given points of their closest set.
Contact measure_parallel(const SurfacePair& pair, const FeaturePairKey& key, const Eigen::Vector3d& point_a,
                         const Eigen::Vector3d& point_b);

/// The point where a segment meets the plane of a triangle. Its ends are not on one side of the plane, nor
/// both in it. The error is as small as that of a contact's point.
Eigen::Vector3d crossing_point(const Simplex& segment, const Simplex& triangle, DecisionCount& count);

Witness witness_of(const Contact& contact);

}  // namespace graze
