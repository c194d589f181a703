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
/// Of 100 steps 99 are to end within their budget, a tenth of it and half a millisecond; with one thread in
/// processor time, so that what else the machine does is not counted, otherwise in wall time. A report is
/// to say that it is complete if and only if all its pairs are, and an incomplete pair is to have no
/// contacts.
StressResult run_budgets_study(const BudgetsOptions& options);

}  // namespace graze::tools
