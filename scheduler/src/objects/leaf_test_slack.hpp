#pragma once

#include <algorithm>

namespace graze {

/// The slack with which two surfaces are tested, so that the result stays valid for some steps. The slack
/// covers `most_steps` steps of their last motion together, up to `most_leaf_sizes` of a leaf's size. If it
/// would cover fewer than `least_steps` steps it is 0, since it would not pay. The constants were measured
/// over scenes played in slow motion (docs/tried.md).
struct SlackOfMotion {
  double most_steps;
  double most_leaf_sizes;
  static constexpr double least_steps = 3;

  [[nodiscard]] constexpr double of(double motion, double leaf) const {
    const double slack = std::min(most_steps * motion, most_leaf_sizes * leaf);
    return slack >= least_steps * motion ? slack : 0;
  }
};

/// The slack of leaf tests for closest points, of lists of features, and of lists of vertices.
inline constexpr SlackOfMotion leaf_test_slack{64, 1.0 / 64};
inline constexpr SlackOfMotion list_slack_of_features{16, 1.0 / 64};
inline constexpr SlackOfMotion list_slack_of_vertices{16, 1.0 / 32};

}  // namespace graze
