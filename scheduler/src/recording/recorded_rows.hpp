#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "recording/records.hpp"

namespace graze {

/// One row of a report in a recording: the numbers that people ask for, and hashes of everything.
struct RecordedRow {
  ObjectId a;
  ObjectId b;
  PairPhase phase = PairPhase::near;
  bool complete = true;
  bool stale = false;
  bool contacts_cut = false;
  double lower = 0;
  double upper = 0;
  std::uint64_t contacts = 0;
  /// The hash of bounds, witness, contacts and region distances. They follow from where the objects are now.
  std::uint64_t answer_hash = 0;
  /// The hash of the phase, of the contacts' ages, and of what met on the way. They follow from the steps
  /// before.
  std::uint64_t history_hash = 0;
  /// Something met on the way, or may have. So the row may be listed for that alone.
  bool is_of_sweep = false;

  friend bool operator==(const RecordedRow&, const RecordedRow&) = default;
};

/// A report in a recording.
struct RecordedReport {
  std::uint64_t frame = 0;
  std::uint64_t tag = 0;
  bool complete = true;
  double step_ms = 0;
  std::uint64_t pairs = 0;  ///< rows
  std::uint64_t pairs_in_contact = 0;
  std::uint64_t contacts = 0;
  std::uint64_t diagnostics = 0;
  std::uint64_t diagnostics_hash = 0;  ///< of their objects and kinds
  std::vector<RecordedRow> rows;
};

template <Is<RecordedRow> T>
auto fields(T& r) {
  return std::tie(r.a, r.b, r.phase, r.complete, r.stale, r.contacts_cut, r.lower, r.upper, r.contacts,
                  r.answer_hash, r.history_hash, r.is_of_sweep);
}
template <Is<RecordedReport> T>
auto fields(T& r) {
  return std::tie(r.frame, r.tag, r.complete, r.step_ms, r.pairs, r.pairs_in_contact, r.contacts,
                  r.diagnostics, r.diagnostics_hash, r.rows);
}

/// Fills `recorded` from a report. The rows' memory is used again.
void summarize(const FrameReport& report, RecordedReport& recorded);

/// One hash of the whole report: of its rows, ids included, and of its diagnostics.
[[nodiscard]] std::uint64_t hash_of(const RecordedReport& report);

}  // namespace graze
