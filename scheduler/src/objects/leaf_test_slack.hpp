#pragma once

#include <algorithm>

namespace graze {

/// How much further than need be two surfaces are looked at, so that what is found out lasts: for some steps
/// of their last motion together, as long as that is far less than a leaf. For less than a few steps it does
/// not pay. Measured over scenes played in slow motion (docs/tried.md).
struct SlackOfMotion {
  double most_steps;
  double most_leaf_sizes;
  static constexpr double least_steps = 3;

  [[nodiscard]] constexpr double of(double motion, double leaf) const {
    const double slack = std::min(most_steps * motion, most_leaf_sizes * leaf);
    return slack >= least_steps * motion ? slack : 0;
  }
};

/// For the closest points, for lists of features, and for those of vertices.
inline constexpr SlackOfMotion leaf_test_slack{64, 1.0 / 64};
inline constexpr SlackOfMotion list_slack_of_features{16, 1.0 / 64};
inline constexpr SlackOfMotion list_slack_of_vertices{16, 1.0 / 32};

}  // namespace graze
