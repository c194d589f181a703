#pragma once

#include <graze/report.hpp>
#include <span>
#include <string>
#include <vector>

namespace graze::tests {

/// Every bit of a pair's row, its contacts and its impacts as text, but for where they lie in the report.
std::string text_of(const FrameReport& report, const PairReport& pair);

/// The text of a row that does not lie in a report, with its contacts.
std::string text_of(const PairReport& pair, std::span<const Contact> contacts);

/// The rows of a report, each with its contacts.
std::vector<std::string> rows_of(const FrameReport& report);

/// Returns the rows of a report as text, so that they equal those of a scene built afresh with the same
/// positions. Rows that are listed only because they ended are left out, as is all that depends on the last
/// step. What a pair met on the way is such a thing.
std::vector<std::string> timeless_rows_of(const FrameReport& report, double range);

/// Empty where frame, rows, contacts, diagnostics and completeness are the same, bit for bit.
std::string difference_of(const FrameReport& left, const FrameReport& right);

/// Describes an inconsistency within a report. Empty where there is none. Pairs or contacts may be in wrong
/// order, or contacts stand in rows that have none. Spans may not follow one another. Bounds may be the wrong
/// way round, or numbers not finite. What is said of impacts may not fit together.
std::string inconsistency_of(const FrameReport& report);

}  // namespace graze::tests
