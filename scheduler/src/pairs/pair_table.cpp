#include "pairs/pair_table.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

/// A memory is prefetched this many pairs before it is used.
constexpr std::size_t ahead = 12;

}  // namespace

PairList PairTable::list(const FrameReport& previous, std::span<Object* const> tools, TaskPool& tasks,
                         std::vector<Diagnostic>& diagnostics, StepStatistics& statistics) {
  const auto objects = store_.objects();
  statistics.objects = objects.size();
  statistics.pairs_total = objects.empty() ? 0 : std::uint64_t{objects.size()} * (objects.size() - 1) / 2;
  summaries_.refresh(objects, tasks, store_.insertions());
  if (store_.swept().some()) summaries_.take_up_sweeps(objects, store_.swept());
  find_listed(previous);
  find_ended(previous);
  const auto close = self_pairs_.add_to(broad_phase_.find(summaries_, filter_.half_reaches(), filter_, tasks),
                                        store_, filter_);
  statistics.pairs_total += self_pairs_.count();
  filter_.forget_changed();
  count_filtered(statistics);
  statistics.work.boxes_tested = broad_phase_.counters().boxes_tested;
  statistics.objects_in_slack = broad_phase_.counters().objects_in_slack;
  if (summaries_.some_unread()) read_near_objects(close, tools, tasks, diagnostics);
  list_jobs(selection_.select(close, listed_, summaries_, filter_, tasks, statistics), previous);
  // The pairs counted as unchanged so far are at rest and have no job.
  const std::size_t pair_count = jobs_.size() + static_cast<std::size_t>(statistics.pairs_unchanged);
  count_jobs(statistics);
  return {jobs_, last_rows_, pair_count};
}

void PairTable::count_filtered(StepStatistics& statistics) const {
  const FilteredPairs& filtered = broad_phase_.filtered();
  statistics.pairs_fixed = filtered.fixed;
  statistics.pairs_by_layer = filtered.by_layer;
  statistics.pairs_in_group = filtered.in_group;
  statistics.pairs_ignored = filter_.ignored_count();
  statistics.pairs_filtered = statistics.pairs_fixed + statistics.pairs_by_layer + statistics.pairs_in_group +
                              statistics.pairs_ignored;
}

/// Finds the pairs of the last report by the current slots of their objects.
void PairTable::find_listed(const FrameReport& previous) {
  // The rows are those of another report if a step did not list pairs, or after a failed step.
  if (rows_frame_ != previous.frame()) return look_up_listed(previous);
  listed_.swap(rows_);
  const auto new_slots = summaries_.new_slots();
  if (new_slots.empty()) return;
  std::size_t kept = 0;
  for (const auto [pair, row] : listed_)
    if (const SlotPair moved = remapped_pair(pair, new_slots); moved != no_pair)
      listed_[kept++] = {moved, row};
  listed_.resize(kept);
}

void PairTable::look_up_listed(const FrameReport& previous) {
  listed_.clear();
  for (std::uint32_t row = 0; row < previous.pairs().size(); ++row) {
    const Object* const a = store_.find(previous.pairs()[row].a);
    const Object* const b = store_.find(previous.pairs()[row].b);
    if (a != nullptr && b != nullptr)
      listed_.push_back({pair_of(summaries_.slot_of(*a), summaries_.slot_of(*b)), row});
  }
}

/// Finds the pairs in contact in the last report of which an object was removed since, in that report's
/// order.
void PairTable::find_ended(const FrameReport& previous) {
  ended_.clear();
  ended_listed_ = 0;
  if (store_.departed().empty()) return;
  for (std::uint32_t row = 0; row < previous.pairs().size(); ++row) {
    const PairReport& pair = previous.pairs()[row];
    if (!is_contact(pair.phase)) continue;
    if (store_.find(pair.a) != nullptr && store_.find(pair.b) != nullptr) continue;
    ended_.push_back({{serial_of(pair.a), serial_of(pair.b)}, row});
  }
}

/// The serial of an object, which may have been removed since the last report.
std::uint64_t PairTable::serial_of(ObjectId id) {
  if (const Object* const object = store_.find(id)) return object->serial;
  return std::lower_bound(store_.departed().begin(), store_.departed().end(), id,
                          [](const DepartedObject& departed, ObjectId value) { return departed.id < value; })
      ->serial;
}

/// Lists the ended pairs that come before a pair.
void PairTable::list_ended(SerialPair before) {
  for (; ended_listed_ < ended_.size() && ended_[ended_listed_].pair < before; ++ended_listed_)
    last_rows_.push_back({jobs_.size(), 0, ended_[ended_listed_].row, 1, true});
}

void PairTable::begin_rows(std::uint64_t frame) {
  rows_.clear();
  row_count_ = 0;
  rows_frame_ = frame;
  std::size_t most = jobs_.size();
  for (const LastRows& rows : last_rows_) most += rows.count;
  rows_.reserve(most);
}

void PairTable::add_rows(const LastRows& rows) {
  for (std::uint32_t i = 0; i < rows.count; ++i) add_row(listed_[rows.listed + i].pair);
}

/// Reads unread objects where their boxes show that they may be near another object, since a pair with one
/// can only be near then. Also reads changed objects of the last report's pairs, since this report has to
/// mention these pairs again.
void PairTable::read_near_objects(std::span<const SlotPair> pairs, std::span<Object* const> tools,
                                  TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  wanted_.clear();
  const bool same_filter = std::exchange(filter_version_, filter_.version()) == filter_.version();
  for (const SlotPair pair : pairs) {
    // Both objects are read, or an earlier step found them apart.
    if (same_filter && !summaries_.changed(first_of(pair)) && !summaries_.changed(second_of(pair))) continue;
    const ObjectSummary& a = summaries_[first_of(pair)];
    const ObjectSummary& b = summaries_[second_of(pair)];
    if ((a.unread || b.unread) && lower_distance(a.box, b.box) <= filter_.reach(a, b)) {
      want(first_of(pair));
      want(second_of(pair));
    }
  }
  for (const ListedPair& listed : listed_)
    for (const std::uint32_t slot : {first_of(listed.pair), second_of(listed.pair)})
      if (summaries_.changed(slot)) want(slot);
  for (const Object* const tool : tools) want_near(*tool);
  if (wanted_.empty()) return;
  store_.read_unread(wanted_, tasks, diagnostics);
  summaries_.refresh(wanted_);
}

/// Wants an object to be read in this step, if it is not.
void PairTable::want(std::uint32_t slot) {
  Object* const object = store_.objects()[slot].get();
  if (object->is_unread() && std::exchange(object->plan, ReadPlan::read) == ReadPlan::skip)
    wanted_.push_back(object);
}

/// Wants a tool that has a patch, and what may be in it.
void PairTable::want_near(const Object& tool) {
  const std::uint32_t slot = summaries_.slot_of(tool);
  const ObjectSummary& summary = summaries_[slot];
  want(slot);
  for (std::uint32_t other = 0; other < summaries_.all().size(); ++other)
    if (summaries_[other].unread && !summaries_[other].hidden &&
        filter_.verdict(summary, summaries_[other]) == PairVerdict::tested &&
        lower_distance(summary.box, summaries_[other].box) <= tool.settings.patch_radius)
      want(other);
}

void PairTable::list_jobs(std::span<const SelectedPair> selected, const FrameReport& previous) {
  jobs_.clear();
  last_rows_.clear();
  jobs_.reserve(selected.size());  // no more than that: with millions of pairs half as much again is felt
  for (std::size_t i = 0; i < selected.size(); ++i) {
    if (i + ahead < selected.size()) selection_.prefetch(selected[i + ahead]);
    const SelectedPair& each = selected[i];
    if (ended_listed_ < ended_.size())
      list_ended({summaries_[first_of(each.pair)].serial, summaries_[second_of(each.pair)].serial});
    if (each.kind == SelectedPair::Kind::resting) {
      last_rows_.push_back({jobs_.size(), each.listed, listed_[each.listed].row, each.count});
      continue;
    }
    PairJob job = job_of(each, previous);
    job.is_swept =
        each.kind == SelectedPair::Kind::tested && summaries_.may_meet_on_way(each.pair, filter_.swept_gap());
    if (each.kind == SelectedPair::Kind::tested || says_something(job))
      add(job, each);
    else
      selection_.forget(each);
  }
  constexpr std::uint64_t behind_all = std::numeric_limits<std::uint64_t>::max();
  list_ended({behind_all, behind_all});
}

PairJob PairTable::job_of(const SelectedPair& selected, const FrameReport& previous) const {
  PairJob job;
  job.slots = selected.pair;
  job.a = store_.objects()[first_of(selected.pair)].get();
  job.b = store_.objects()[second_of(selected.pair)].get();
  if (selected.listed != SelectedPair::none) job.last = &previous.pairs()[listed_[selected.listed].row];
  const ObjectSummary& a = summaries_[first_of(selected.pair)];
  const ObjectSummary& b = summaries_[second_of(selected.pair)];
  job.thresholds = filter_.thresholds(a, b);
  job.groups = filter_.groups(a, b);
  return job;
}

/// Decides whether the report mentions a pair of the last report that is now filtered out, apart or frozen. A
/// pair that was in contact is listed once more, however far apart it is.
bool PairTable::says_something(PairJob& job) const {
  const ObjectSummary& a = summaries_[first_of(job.slots)];
  const ObjectSummary& b = summaries_[second_of(job.slots)];
  job.allowed = filter_.verdict(a, b) == PairVerdict::tested && !a.hidden && !b.hidden;
  if (!job.allowed && !job.was_in_contact()) return false;
  if (!job.allowed) job.task = PairJob::Task::end;
  if (a.frozen || b.frozen) {
    job.task = PairJob::Task::repeat_last;
    return true;
  }
  return job.was_in_contact() || may_be_near(lower_distance(a.box, b.box), job.thresholds.reach);
}

void PairTable::add(PairJob job, const SelectedPair& selected) {
  job.memory = &selection_.memory_of(selected);
  if (store_.some_replaced() && job.speaks_of_replaced()) job.memory->forget();
  // The threshold of an object with itself says which features are near enough at rest to be left out.
  const bool is_of_other_rule = job.is_of_self() && job.memory->rules_version != filter_.rules_version();
  if (job.memory->groups_version != job.groups.version || is_of_other_rule) {
    // The answer holds no more, and the front lacks what those groups left out.
    job.memory->front.forget();
    job.memory->version_a = job.memory->version_b = 0;
    job.memory->groups_version = job.groups.version;
  }
  if (job.task == PairJob::Task::detect && is_unchanged(job)) {
    job.task = PairJob::Task::unchanged;
    if (may_rest_ && selected.kind == SelectedPair::Kind::tested) selection_.let_rest(selected);
  }
  jobs_.push_back(job);
}

/// Whether the last answer still holds, since positions and rules are the same.
bool PairTable::is_unchanged(const PairJob& job) const {
  return job.memory->version_a == summaries_[first_of(job.slots)].version &&
         job.memory->version_b == summaries_[second_of(job.slots)].version &&
         job.memory->rules_version == filter_.rules_version();
}

void PairTable::count_jobs(StepStatistics& statistics) const {
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    prefetch_ahead(jobs_, i, &Object::demand);
    const PairJob& job = jobs_[i];
    if (job.is_tested()) {
      ++statistics.pairs_tested;
      for (Object* const object : {job.a, job.b})
        if (object->demand == Demand::nothing) object->demand = Demand::test;
    }
    if (job.task == PairJob::Task::unchanged) ++statistics.pairs_unchanged;
  }
}

void PairTable::reserve(std::size_t objects, std::size_t pairs, const PairMemoryRoom& room) {
  summaries_.reserve(objects);
  broad_phase_.reserve(objects, pairs);
  self_pairs_.reserve(pairs);
  selection_.reserve(pairs, room);
  jobs_.reserve(pairs);
  last_rows_.reserve(pairs);
  listed_.reserve(pairs);
  rows_.reserve(pairs);
  ended_.reserve(pairs);
  wanted_.reserve(objects);
}

std::size_t PairTable::byte_count() const {
  return filter_.byte_count() + summaries_.byte_count() + broad_phase_.byte_count() +
         self_pairs_.byte_count() + selection_.byte_count() + bytes_of(jobs_) + bytes_of(last_rows_) +
         bytes_of(listed_) + bytes_of(rows_) + bytes_of(ended_) + bytes_of(wanted_);
}

}  // namespace graze
