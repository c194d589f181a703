#pragma once

#include <Eigen/Core>

#include "search/workers/search_progress.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"
#include "solid/contour.hpp"

namespace graze {

/// Completes an answer with the way out of a pair (`PairAnswer::way_out`), on one thread. The answer is there
/// otherwise, and `SolidSearch` has completed it if the pair has a solid.
class WayOutSearch {
 public:
  WayOutSearch(SearchedPair& pair, SearchWorker& worker)
      : pair_(pair), worker_(worker), scratch_(worker.scratch.way_out) {}

  SearchProgress complete();

 private:
  [[nodiscard]] bool may_cross() const;
  [[nodiscard]] bool list_near(double distance);
  [[nodiscard]] bool pierces() const;
  void measure(const Contour& contour) const;
  [[nodiscard]] double thickness_along(const Eigen::Vector3d& direction, const Contour& contour) const;
  [[nodiscard]] double extent_along(const Eigen::Vector3d& direction) const;

  SearchedPair& pair_;
  SearchWorker& worker_;
  WayOutScratch& scratch_;
};

}  // namespace graze
