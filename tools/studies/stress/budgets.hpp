#pragma once

#include <cstddef>

#include "stress/result.hpp"

namespace graze::tools {

struct BudgetsOptions {
  std::size_t frames = 100;  ///< of each scene
  unsigned threads = 1;
};

/// Steps clusters of bodies that are all in contact with all, with time budgets of 2 and 10 ms: four details,
/// thresholds of 0.5, 2 and 5 edge lengths, bodies of 800 and 3,900 vertices. Prints how long steps take.
///
/// Out of 100 steps, 99 have to end within their budget, a tenth of it and half a millisecond. With one
/// thread this is processor time, so that other load on the machine does not count. Otherwise it is wall
/// time. A report has to say that it is complete if and only if all its pairs are. An incomplete pair must
/// have no contacts.
StressResult run_budgets_study(const BudgetsOptions& options);

}  // namespace graze::tools
