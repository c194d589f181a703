#include "step/row_writer.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "step/report_rows.hpp"

namespace graze {
namespace {

/// Counts a pair whose contacts were cut. At least one was left out, and more where their number is known.
void count_cut(std::size_t left_out, StepStatistics& statistics) {
  ++statistics.pairs_cut;
  statistics.contacts_left_out += std::max<std::size_t>(left_out, 1);
}

void set_ended(PairReport& row) {
  row.phase = PairPhase::ended;
  row.inside = Inside::none;
  row.way_out = {};
}

}  // namespace

bool RowWriter::write(const PairList& list, const FrameReport& previous, ReportBuilder& builder) {
  rows_again_ = 0;
  contacts_.begin();
  pairs_.begin_rows(builder.frame());
  auto rows = list.last_rows.begin();
  const auto write_rows_before = [&](std::size_t job) {
    for (; rows != list.last_rows.end() && rows->job == job; ++rows)
      rows->ended ? end_pair(previous.pairs()[rows->row], builder) : repeat_pairs(*rows, previous, builder);
  };
  for (std::size_t index = 0; index < list.jobs.size(); ++index) {
    prefetch_ahead(list.jobs, index, &Object::id, &Object::settings);
    write_rows_before(index);
    write_pair(list.jobs[index], index, previous, builder);
  }
  write_rows_before(list.jobs.size());
  if (std::vector<Contact>* const longest = jobs_.longest_list()) contacts_.adopt_list(*longest, builder);
  contacts_.write(tasks_, builder.contacts(), builder.frame());
  const StepStatistics& statistics = builder.statistics();
  return statistics.pairs_tested == 0 && rows_again_ == statistics.pairs_near;
}

void RowWriter::write_pair(const PairJob& job, std::size_t index, const FrameReport& previous,
                           ReportBuilder& builder) {
  const bool repeats = !job.is_tested();
  const PairAnswers& answers = jobs_.answers();
  std::optional<PairReport> row = repeats ? row_again(job) : row_of(job, answers[index]);
  if (!row) return;
  const std::size_t left_out = answers.contacts_left_out(index);
  if (left_out > 0) row->contacts_cut = true;
  if (job.is_swept) add_sweep(index, *row, builder);
  if (row->contacts_cut) row->complete = false;
  const bool in_contact = is_contact(row->phase);
  const auto contacts = in_contact ? answers.contacts(index) : std::span<const Contact>();
  repeats ? contacts_.add_again(contacts) : contacts_.add(contacts, last_contacts_.of(index));
  auto regions = repeats ? previous.region_distances(*job.last) : answers[index].region_distances;
  if (repeats && is_of_old_mesh(job)) regions = {};
  builder.add(*row, contacts.size(), regions);
  pairs_.add_row(job);
  StepStatistics& statistics = builder.statistics();
  ++statistics.pairs_near;
  if (in_contact) ++statistics.pairs_in_contact;
  statistics.contacts += contacts.size();
  statistics.region_distances += regions.size();
  if (!repeats) statistics.region_distances_left_out += answers[index].region_distances_left_out;
  if (row->contacts_cut) count_cut(left_out, statistics);
}

/// Adds to a row what met on the way.
void RowWriter::add_sweep(std::size_t index, PairReport& row, ReportBuilder& builder) {
  const SweptJob& swept = sweeps_.of(index);
  // A row that a budget cut short is not said to be cut by a limit: its distance is not that of now.
  if (swept.left_out > 0 && row.complete) row.contacts_cut = true;
  row.time_of_impact = swept.time_of_impact;
  row.time_of_gap = swept.time_of_gap;
  row.complete = row.complete && swept.complete;
  builder.add_impacts(row, swept.impacts);
  builder.statistics().impacts += swept.impacts.size();
}

/// The row of a pair that was not tested, or nothing if the report does not list it.
std::optional<PairReport> RowWriter::row_again(const PairJob& job) {
  std::optional<PairReport> row = repeated_row(job);
  if (!row) return row;
  if (is_of_old_mesh(job)) row->witness = mapped_witness(job);
  if (!job.allowed) set_ended(*row);
  if (row->phase == job.last->phase && row->stale == job.last->stale) ++rows_again_;
  return row;
}

/// Writes the last row of a pair in contact that ends because one of its objects was removed.
void RowWriter::end_pair(PairReport row, ReportBuilder& builder) {
  set_ended(row);
  row.complete = true;
  row.stale = row.contacts_cut = false;
  forget_sweep(row);
  builder.add(row, 0, {});
  pairs_.pass_row();
  ++builder.statistics().pairs_near;
}

/// Repeats rows of the last report with their contacts and distances of regions.
void RowWriter::repeat_pairs(const LastRows& resting, const FrameReport& previous, ReportBuilder& builder) {
  StepStatistics& statistics = builder.statistics();
  const auto rows = previous.pairs().subspan(resting.row, resting.count);
  const PairReport& first = rows.front();
  const PairReport& last = rows.back();
  const auto contacts = previous.contacts().subspan(
      first.first_contact, last.first_contact + last.contact_count - first.first_contact);
  const auto regions = previous.region_distances().subspan(
      first.first_region_distance,
      last.first_region_distance + last.region_distance_count - first.first_region_distance);
  contacts_.add_again(contacts);
  builder.add_again(rows, regions);
  pairs_.add_rows(resting);
  rows_again_ += rows.size();
  statistics.pairs_near += rows.size();
  statistics.contacts += contacts.size();
  statistics.region_distances += regions.size();
  for (const PairReport& row : rows) {
    if (is_contact(row.phase)) ++statistics.pairs_in_contact;
    if (row.contacts_cut) count_cut(0, statistics);
  }
}

}  // namespace graze
