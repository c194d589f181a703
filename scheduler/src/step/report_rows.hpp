#pragma once

#include <graze/report.hpp>
#include <optional>

#include "jobs/pair_answers.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// The row of a pair that was tested, or nothing if the report does not list it.
std::optional<PairReport> row_of(const PairJob& job, const KeptAnswer& answer);

/// The row of a pair that was not tested: its last row again, or nothing if the report does not list it.
std::optional<PairReport> repeated_row(const PairJob& job);

/// Forgets that a limit has left something out, for a row that has no more contacts and impacts.
void forget_cut(PairReport& row);

/// Forgets what met on the way to another step.
void forget_sweep(PairReport& row);

}  // namespace graze
