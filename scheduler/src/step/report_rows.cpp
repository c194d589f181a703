#include "step/report_rows.hpp"

namespace graze {

std::optional<PairReport> repeated_row(const PairJob& job) {
  if (job.last == nullptr) return std::nullopt;
  PairReport row = *job.last;
  if (!job.allowed || !is_contact(row.phase)) forget_cut(row);
  forget_sweep(row);
  row.stale = job.task == PairJob::Task::repeat_last;
  if (row.phase == PairPhase::began) row.phase = PairPhase::touching;
  if (row.phase != PairPhase::ended) return row;
  row.phase = PairPhase::near;
  if (row.distance.lower < job.thresholds.reach) return row;
  return std::nullopt;
}

void forget_cut(PairReport& row) {
  // A row is only cut by a limit where its search came to an end.
  if (row.contacts_cut) row.complete = true;
  row.contacts_cut = false;
}

void forget_sweep(PairReport& row) {
  row.time_of_impact = row.time_of_gap = 1;
  row.first_impact = row.impact_count = 0;
}

std::optional<PairReport> row_of(const PairJob& job, const KeptAnswer& answer) {
  const bool was = job.was_in_contact();
  PairReport row;
  row.a = job.a->id;
  row.b = job.b->id;
  row.user_data_a = job.a->settings.user_data;
  row.user_data_b = job.b->settings.user_data;
  row.contacts_cut = answer.cut || answer.contacts_left_out > 0;
  row.complete = answer.complete && !row.contacts_cut;
  if (answer.complete) {
    row.inside = answer.inside;
    row.way_out = answer.way_out;
  }
  row.distance = answer.distance;
  row.witness = answer.witness;
  if (job.task == PairJob::Task::end)
    row.phase = PairPhase::ended;
  else if (!answer.complete)
    row.phase = was ? PairPhase::touching : PairPhase::near;
  else if (answer.in_contact)
    row.phase = was ? PairPhase::touching : PairPhase::began;
  else
    row.phase = was ? PairPhase::ended : PairPhase::near;
  if (answer.listed || was) return row;
  return std::nullopt;
}

}  // namespace graze
