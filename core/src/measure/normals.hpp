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

/// The angle-weighted normal of a feature (Baerentzen and Aanaes, "Signed distance computation using the
/// angle weighted pseudonormal"), not normalised: of a vertex its triangles' normals by their angles there,
/// of an edge the sum of its triangles' normals, of a face its normal. Zero where there is none.
Eigen::Vector3d weighted_normal(const Surface& surface, const FeaturePiece& piece, DecisionCount& count);

/// On which side of a surface, at a feature, the vector `gap` leads.
Side side_of(const Surface& surface, const FeaturePiece& piece, const Eigen::Vector3d& gap,
             DecisionCount& count);

/// The normal of a contact whose points are one, from positions alone: a's face normal; else minus b's face
/// normal; else for two edges their cross product, signed to agree with a's averaged vertex normal; else a's
/// averaged normal, else minus b's, else +z.
Eigen::Vector3d touching_normal(const Surface& surface_a, const FeaturePiece& piece_a,
                                const Surface& surface_b, const FeaturePiece& piece_b, DecisionCount& count);

}  // namespace graze
