#pragma once

#include <graze/settings.hpp>

#include "jobs/pair_jobs.hpp"
#include "jobs/pair_sweeps.hpp"
#include "jobs/region_refit.hpp"
#include "pairs/pair_table.hpp"
#include "report/report_pool.hpp"
#include "step/row_writer.hpp"
#include "step/scene_content.hpp"

namespace graze {

/// Reserves the memory of all parts of a step ahead of time, as Scene::reserve() says. Stepping thread only.
class StepReserve {
 public:
  StepReserve(const SceneSettings& settings, SceneContent& content, ReportPool& reports, PairTable& pairs,
              RegionRefit& refit, PairSweeps& sweeps, PairJobs& jobs, RowWriter& rows)
      : settings_(settings),
        content_(content),
        reports_(reports),
        pairs_(pairs),
        refit_(refit),
        sweeps_(sweeps),
        jobs_(jobs),
        rows_(rows) {}

  /// Reserves memory, unless all numbers are 0.
  void reserve(const SceneCapacity& capacity);
  /// Whether near pairs have reserved memory. Then objects that come later are prepared, too.
  [[nodiscard]] bool is_for_pairs() const { return is_for_pairs_; }
  /// Prepares an object for its first pair: the bounds of its regions, room for its leaves in working memory,
  /// and positions by pose.
  void prepare_surface(Surface& surface, const ObjectSettings& settings);
  /// Reserves memory for the positions of a bound object, which are copied when it comes near another. An
  /// object that can be viewed needs no copy.
  void prepare_copy(Object& object);

 private:
  void reserve_for_sweeps(const SceneCapacity& capacity);
  void reserve_for_pairs(const SceneCapacity& capacity);

  const SceneSettings& settings_;
  SceneContent& content_;
  ReportPool& reports_;
  PairTable& pairs_;
  RegionRefit& refit_;
  PairSweeps& sweeps_;
  PairJobs& jobs_;
  RowWriter& rows_;
  bool is_for_pairs_ = false;
};

}  // namespace graze
