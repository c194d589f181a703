#pragma once

#include <cstdint>
#include <graze/settings.hpp>

#include "base/contact_limit.hpp"
#include "recording/recorded_rows.hpp"

namespace graze {

/// What a replay can say of one row.
enum class RowVerdict : std::uint8_t {
  same,          ///< the row is the recorded one
  holds,         ///< what must be equal is, and the rest follows from what the replay does not know
  not_compared,  ///< the whole row follows from what the replay does not know
  differs,
};

/// Compares rows of a recording with those of its replay.
///
/// A replay that knows the whole history of the scene has the recorded rows, bit for bit. One that begins
/// amid a run, or has some of the objects alone, does not know the steps before and the other pairs. Then
/// bounds of `Accuracy::within`, what a budget leaves out, the share of a pair in `max_contacts` and in
/// `region_distances`, the contacts that `carrying` chooses, phases and ages may be others, and nothing has
/// diverged. The same holds after a step that a time budget cut short, since a replay has none.
class RowComparison {
 public:
  RowComparison(const SceneSettings& settings, bool knows_history)
      : settings_(settings), limit_(settings), knows_all_(knows_history && !settings.time_budget) {}

  /// Each row is null where its report does not list the pair, and not both are. All pairs have at least the
  /// range `least_range`.
  [[nodiscard]] RowVerdict compare(const RecordedRow* recorded, const RecordedRow* replayed,
                                   double least_range) const;

 private:
  [[nodiscard]] RowVerdict compare_in_both(const RecordedRow& recorded, const RecordedRow& replayed) const;
  [[nodiscard]] RowVerdict compare_answers(const RecordedRow& recorded, const RecordedRow& replayed) const;
  [[nodiscard]] bool must_be_listed(const RecordedRow& row, double least_range) const;
  [[nodiscard]] bool has_loose_bounds(const RecordedRow& row) const;

  const SceneSettings& settings_;
  const ContactLimit limit_;
  bool knows_all_;
};

}  // namespace graze
