#pragma once

#include <graze/contact.hpp>
#include <optional>

#include "closest_features/closest_features.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// The unit normal of one triangle of a face by its winding, or of a fold the normalised sum of its
/// triangles'. Nothing where there is no area.
std::optional<Eigen::Vector3d> face_normal(const Surface& surface, const FeaturePiece& piece,
                                           DecisionCount& count);

/// The angle-weighted normal of a feature, not normalised. It is zero where there is none (Baerentzen and
/// Aanaes, "Signed distance computation using the angle weighted pseudonormal"). A vertex has its triangles'
/// normals, weighted by their angles there. An edge has the sum of its triangles' normals, and a face its
/// own.
Eigen::Vector3d weighted_normal(const Surface& surface, const FeaturePiece& piece, DecisionCount& count);

/// On which side of a surface, at a feature, the vector `gap` leads.
Side side_of(const Surface& surface, const FeaturePiece& piece, const Eigen::Vector3d& gap,
             DecisionCount& count);

/// The normal of a contact whose points are one, from positions alone. It is the first of these that exists:
/// a's face normal, then minus b's face normal, then for two edges their cross product, signed to agree with
/// a's averaged vertex normal. Otherwise it is a's averaged normal, minus b's, or +z.
Eigen::Vector3d touching_normal(const Surface& surface_a, const FeaturePiece& piece_a,
                                const Surface& surface_b, const FeaturePiece& piece_b, DecisionCount& count);

}  // namespace graze
