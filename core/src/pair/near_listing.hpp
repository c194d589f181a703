#pragma once

#include <vector>

#include "core/pair/near_list.hpp"

namespace graze {

/// A list for pairs of features that may be in contact before the surfaces have moved by a slack.
struct NearListing {
  std::vector<FeaturePair>* pairs = nullptr;  ///< nowhere
  double slack = 0;

  [[nodiscard]] bool is_wanted() const { return pairs != nullptr; }
  void add(const FeatureRef& a, const FeatureRef& b) const {
    // A quad's second triangle mostly comes right after its first.
    if (is_wanted() && (pairs->empty() || pairs->back() != FeaturePair{a, b})) pairs->push_back({a, b});
  }
};

}  // namespace graze
