#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <vector>

#include "core/surface/surface.hpp"

namespace graze {

/// The kind of a feature that a list refers to. It is as wide as an index, so that kind and index are
/// compared at once.
enum class FeatureRefKind : std::uint32_t { vertex, edge, face, fold };

/// A feature of a surface, by its kind and index. A fold has the index of its quad.
struct FeatureRef {
  FeatureRefKind kind = FeatureRefKind::vertex;
  std::uint32_t index = 0;

  friend bool operator==(const FeatureRef&, const FeatureRef&) = default;
};

/// Two features, one of each surface. They are two vertices, where contacts are of vertices. Otherwise they
/// are a vertex and a face, two edges or folds, or an edge or fold and a face that it may pierce.
struct FeaturePair {
  FeatureRef a;
  FeatureRef b;

  friend bool operator==(const FeaturePair&, const FeaturePair&) = default;
};

/// All pairs of features of two surfaces that may be in contact while they hardly move: those that a search
/// found nearer than a distance somewhat above the threshold. As long as the surfaces have moved less than
/// that, a query asks these and no others.
struct NearList {
  std::vector<FeaturePair> pairs;
  /// A lower bound of the distance, at the two marks, of every pair that is not listed. It is negative where
  /// nothing is known.
  double unlisted_lower_bound = -1;
  /// The motion below which no edge that is not listed can come to pierce a face that it is not listed with.
  double slack = 0;
  Travel travel_a;
  Travel travel_b;

  void forget() {
    pairs.clear();
    unlisted_lower_bound = -1;
  }
  /// Whether all contacts below a threshold are among those listed.
  [[nodiscard]] bool serves(const Surface& a, const Surface& b, double threshold) const {
    if (!(unlisted_lower_bound > 0)) return false;
    const double motion = (a.motion_since(travel_a) + b.motion_since(travel_b)) * round_up;
    return motion < slack && (unlisted_lower_bound - motion) * round_down >= threshold;
  }
  /// Whether some listed vertices are certainly nearer than a threshold.
  [[nodiscard]] GRAZE_API bool has_vertices_within(const Surface& a, const Surface& b,
                                                   double threshold) const;
};

}  // namespace graze
