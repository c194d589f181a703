#include "pair_table.hpp"

#include <graze/bytes_of.hpp>
#include <utility>

namespace graze {

PairTable::PairTable(const SceneSettings& settings, ObjectStore& store) : store_(store), filter_(settings) {}

std::span<const PairJob> PairTable::list(const FrameReport& previous, TaskPool& tasks,
                                         std::vector<Diagnostic>& diagnostics, StepStatistics& statistics) {
  const auto objects = store_.objects();
  statistics.objects = objects.size();
  statistics.pairs_total = objects.empty() ? 0 : std::uint64_t{objects.size()} * (objects.size() - 1) / 2;
  summaries_.refresh(objects, tasks);
  const auto close = broad_phase_.find(summaries_, filter_.half_reaches(), tasks);
  statistics.boxes_tested = broad_phase_.counters().boxes_tested;
  statistics.objects_in_slack = broad_phase_.counters().objects_in_slack;
  if (summaries_.some_unread()) read_what_is_near(close, previous, tasks, diagnostics);
  list_jobs(selection_.select(close, summaries_, filter_, tasks, statistics), previous, statistics);
  return jobs_;
}

/// A pair of which one object was not read, because of a promise or since it was surveyed, is near only where
/// their boxes are; then it is read after all. So is what the last report listed, since that has to be said
/// of it again.
void PairTable::read_what_is_near(std::span<const PlacePair> pairs, const FrameReport& previous,
                                  TaskPool& tasks, std::vector<Diagnostic>& diagnostics) {
  const auto objects = store_.objects();
  wanted_.clear();
  const auto want = [&](Object* object) {
    if (object != nullptr && object->unread && !std::exchange(object->wanted, true))
      wanted_.push_back(object);
  };
  for (const PlacePair pair : pairs) {
    const ObjectSummary& a = summaries_[first_of(pair)];
    const ObjectSummary& b = summaries_[second_of(pair)];
    if ((a.unread || b.unread) && filter_.verdict(a, b) == PairVerdict::looked_at &&
        lower_distance(a.box, b.box) <= filter_.reach(a, b)) {
      want(objects[first_of(pair)].get());
      want(objects[second_of(pair)].get());
    }
  }
  for (const PairReport& row : previous.pairs()) {
    want(store_.find(row.a));
    want(store_.find(row.b));
  }
  if (wanted_.empty()) return;
  store_.read_unread(wanted_, tasks, diagnostics);
  summaries_.refresh(wanted_);
}

/// Merges the pairs that are to be looked at with those of the last report, some of which have something to
/// be said of all the same: both are sorted by the order of addition, and so are the jobs.
void PairTable::list_jobs(std::span<const PlacePair> selected, const FrameReport& previous,
                          StepStatistics& statistics) {
  const auto objects = store_.objects();
  jobs_.clear();
  memories_.begin();
  auto next = selected.begin();
  const auto key_of = [](const Object& a, const Object& b) { return PairMemories::Key{a.serial, b.serial}; };
  const auto add_next = [&](const PairReport* last) {
    const std::uint32_t a = first_of(*next);
    const std::uint32_t b = second_of(*next++);
    PairJob job;
    job.a = objects[a].get();
    job.b = objects[b].get();
    job.last = last;
    add(job, summaries_[a], summaries_[b]);
  };
  const auto next_key = [&] {
    return PairMemories::Key{summaries_[first_of(*next)].serial, summaries_[second_of(*next)].serial};
  };
  for (const PairReport& row : previous.pairs()) {
    Object* const a = store_.find(row.a);
    Object* const b = store_.find(row.b);
    if (a == nullptr || b == nullptr) continue;
    while (next != selected.end() && next_key() < key_of(*a, *b)) add_next(nullptr);
    if (next != selected.end() && next_key() == key_of(*a, *b))
      add_next(&row);
    else
      add_unselected(*a, *b, row);
  }
  while (next != selected.end()) add_next(nullptr);
  memories_.end();
  for (const PairJob& job : jobs_) {
    if (job.is_looked_at()) {
      ++statistics.pairs_tested;
      job.a->looked_at = job.b->looked_at = true;
    }
    if (job.task == PairJob::Task::unchanged) ++statistics.pairs_unchanged;
  }
}

/// A pair that the last report listed and that is filtered out now, has parted, or is frozen: one that was in
/// contact is listed once more however far it is.
void PairTable::add_unselected(Object& a, Object& b, const PairReport& last) {
  const ObjectSummary& summary_a = summaries_[summaries_.place_of(a)];
  const ObjectSummary& summary_b = summaries_[summaries_.place_of(b)];
  PairJob job;
  job.a = &a;
  job.b = &b;
  job.last = &last;
  job.allowed = filter_.verdict(summary_a, summary_b) == PairVerdict::looked_at;
  if (!job.allowed && !job.was_in_contact()) return;
  if (!job.allowed) job.task = PairJob::Task::end;
  if (a.frozen || b.frozen)
    job.task = PairJob::Task::repeat_last;
  else if (!job.was_in_contact() &&
           !may_be_near(lower_distance(a.box, b.box), filter_.reach(summary_a, summary_b)))
    return;
  add(job, summary_a, summary_b);
}

void PairTable::add(PairJob& job, const ObjectSummary& a, const ObjectSummary& b) {
  job.thresholds = filter_.thresholds(a, b);
  job.memory = &memories_.of({a.serial, b.serial});
  if (job.task == PairJob::Task::detect && is_unchanged(*job.memory, a, b))
    job.task = PairJob::Task::unchanged;
  jobs_.push_back(job);
}

/// Whether the last answer, about the same positions by the same rules, is also this one's.
bool PairTable::is_unchanged(const PairMemory& last, const ObjectSummary& a, const ObjectSummary& b) const {
  return last.version_a == a.version && last.version_b == b.version &&
         last.rules_version == filter_.rules_version();
}

void PairTable::reserve(std::size_t objects, std::size_t pairs, std::size_t leaf_pairs) {
  summaries_.reserve(objects);
  broad_phase_.reserve(objects, pairs);
  selection_.reserve(pairs);
  memories_.reserve(pairs, leaf_pairs);
  jobs_.reserve(pairs);
  wanted_.reserve(objects);
}

std::size_t PairTable::byte_count() const {
  return memories_.byte_count() + filter_.byte_count() + summaries_.byte_count() + broad_phase_.byte_count() +
         selection_.byte_count() + bytes_of(jobs_) + bytes_of(wanted_);
}

}  // namespace graze
