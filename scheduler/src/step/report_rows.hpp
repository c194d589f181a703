#pragma once

#include <graze/report.hpp>
#include <optional>

#include "jobs/pair_answers.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// What a report says of a pair that was looked at; nothing where it is not listed.
std::optional<PairReport> row_of(const PairJob& job, const KeptAnswer& answer);

/// The same of a pair that was not looked at: its last row again.
std::optional<PairReport> repeated_row(const PairJob& job);

}  // namespace graze
