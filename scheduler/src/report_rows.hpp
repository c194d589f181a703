#pragma once

#include <graze/report.hpp>
#include <optional>
#include <span>

#include "pair_answers.hpp"
#include "pair_job.hpp"

namespace graze {

/// What a report says of a pair that was looked at; nothing where it is not listed.
std::optional<PairReport> row_of(const PairJob& job, const KeptAnswer& answer);

/// The same of a pair that was not looked at: its last row again.
std::optional<PairReport> repeated_row(const PairJob& job);

/// Sets since when a pair's contacts have been there, which follow those of the last report; both are sorted
/// by their features.
void set_since(std::span<const Contact> last, std::span<Contact> contacts, std::uint64_t frame);

}  // namespace graze
