#include "replay/row_comparison.hpp"

namespace graze {
namespace {

bool is_in_contact(const RecordedRow& row) {
  return row.phase == PairPhase::began || row.phase == PairPhase::touching;
}

/// Whether a budget cut the search of the pair short. The row has bounds then, and nothing else of now.
bool is_cut_short(const RecordedRow& row) {
  return !row.complete && !row.contacts_cut;
}

/// Whether the row only says what was before.
bool is_of_before(const RecordedRow& row) {
  return row.stale || row.phase == PairPhase::ended;
}

/// The true distance is between both bounds of either row.
bool do_bounds_overlap(const RecordedRow& left, const RecordedRow& right) {
  return left.lower <= right.upper && right.lower <= left.upper;
}

bool are_bounds_equal(const RecordedRow& left, const RecordedRow& right) {
  return left.lower == right.lower && left.upper == right.upper;
}

RowVerdict holds_if(bool condition) {
  return condition ? RowVerdict::holds : RowVerdict::differs;
}

}  // namespace

RowVerdict RowComparison::compare(const RecordedRow* recorded, const RecordedRow* replayed,
                                  double least_range) const {
  if (knows_all_) {
    const bool is_same = recorded != nullptr && replayed != nullptr &&
                         recorded->answer_hash == replayed->answer_hash &&
                         recorded->history_hash == replayed->history_hash;
    return is_same ? RowVerdict::same : RowVerdict::differs;
  }
  if (recorded != nullptr && is_of_before(*recorded)) return RowVerdict::not_compared;
  if (recorded != nullptr && replayed != nullptr) return compare_in_both(*recorded, *replayed);
  const RecordedRow& listed = recorded != nullptr ? *recorded : *replayed;
  return must_be_listed(listed, least_range) ? RowVerdict::differs : RowVerdict::not_compared;
}

/// Whether every report of these positions lists the pair of a row, whatever was before.
bool RowComparison::must_be_listed(const RecordedRow& row, double least_range) const {
  if (is_of_before(row)) return false;
  if (row.upper < least_range) return true;
  if (row.is_of_sweep && !is_in_contact(row)) return false;
  return !is_cut_short(row) && !has_loose_bounds(row);
}

/// Whether the bounds of a row depend on the steps before. They are exact where the pair is in contact.
bool RowComparison::has_loose_bounds(const RecordedRow& row) const {
  return settings_.accuracy.mode() == AccuracyMode::within && !is_in_contact(row);
}

RowVerdict RowComparison::compare_in_both(const RecordedRow& recorded, const RecordedRow& replayed) const {
  if (replayed.stale) return RowVerdict::differs;  // the recorded row is not
  if (is_cut_short(recorded) || is_cut_short(replayed))
    return holds_if(do_bounds_overlap(recorded, replayed));
  if (recorded.answer_hash == replayed.answer_hash) return RowVerdict::same;
  return compare_answers(recorded, replayed);
}

/// Compares two answers that are whole but for a limit, and are not equal.
RowVerdict RowComparison::compare_answers(const RecordedRow& recorded, const RecordedRow& replayed) const {
  if (is_in_contact(recorded) != is_in_contact(replayed)) return RowVerdict::differs;
  const bool is_loose = has_loose_bounds(recorded);
  const bool do_bounds_hold =
      is_loose ? do_bounds_overlap(recorded, replayed) : are_bounds_equal(recorded, replayed);
  if (!do_bounds_hold) return RowVerdict::differs;
  // Of the contacts of a pair the nearest are listed. So as many contacts are the same ones.
  const bool has_other_share =
      limit_.is_shared() && (recorded.contacts_cut || replayed.contacts_cut) &&
      (recorded.contacts != replayed.contacts || recorded.contacts_cut != replayed.contacts_cut);
  if (has_other_share) return RowVerdict::holds;
  // The contacts that carry a pair also follow from those listed before. Either report lists some.
  if (limit_.chooses_carrying() && recorded.contacts > 0 && replayed.contacts > 0) return RowVerdict::holds;
  if (recorded.contacts != replayed.contacts) return RowVerdict::differs;
  return holds_if(is_loose || settings_.region_distances > 0);
}

}  // namespace graze
