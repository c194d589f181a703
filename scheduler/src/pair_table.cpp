#include "pair_table.hpp"

#include <algorithm>

namespace graze {

PairTable::PairTable(const SceneSettings& settings, ObjectStore& store) : store_(store), filter_(settings) {}

Object* PairTable::object_of(std::uint64_t serial) const {
  const auto objects = store_.objects();
  const auto found = std::lower_bound(
      objects.begin(), objects.end(), serial,
      [](const std::unique_ptr<Object>& object, std::uint64_t wanted) { return object->serial < wanted; });
  return found != objects.end() && (*found)->serial == serial ? found->get() : nullptr;
}

/// Merges the pairs that the broad phase finds with those of the last report that were in contact or are
/// frozen: both are sorted by the order of addition, and so are the jobs.
std::span<const PairJob> PairTable::list(const FrameReport& previous, TaskPool& tasks,
                                         std::vector<Diagnostic>& diagnostics, StepStatistics& statistics) {
  const auto objects = store_.objects();
  statistics.objects = objects.size();
  statistics.pairs_total = objects.empty() ? 0 : std::uint64_t{objects.size()} * (objects.size() - 1) / 2;
  jobs_.clear();
  memories_.begin();
  const auto found = broad_phase_.find(objects, filter_.largest_reach());
  read_what_is_near(found, tasks, diagnostics);
  auto pair = found.begin();
  std::size_t last = 0;
  const auto key_of = [&](const ObjectPair& indices) {
    return Key{objects[indices.first]->serial, objects[indices.second]->serial};
  };
  const auto add_last = [&] {
    Object* const a = object_of(last_keys_[last].first);
    Object* const b = object_of(last_keys_[last].second);
    const PairReport& report = previous.pairs()[last++];
    if (a != nullptr && b != nullptr) list_job(*a, *b, &report, statistics);
  };
  for (; pair != found.end(); ++pair) {
    while (last < last_keys_.size() && last_keys_[last] < key_of(*pair)) add_last();
    if (last < last_keys_.size() && last_keys_[last] == key_of(*pair))
      add_last();
    else
      list_job(*objects[pair->first], *objects[pair->second], nullptr, statistics);
  }
  while (last < last_keys_.size()) add_last();
  memories_.end();
  return jobs_;
}

/// A pair of which one object was not read, because of a promise, is near only where the boxes of what was
/// promised are; then it is read after all. So is what the last report listed, since that has to be said of
/// it again.
void PairTable::read_what_is_near(std::span<const ObjectPair> pairs, TaskPool& tasks,
                                  std::vector<Diagnostic>& diagnostics) {
  const auto objects = store_.objects();
  wanted_.clear();
  for (const ObjectPair& pair : pairs) {
    Object& a = *objects[pair.first];
    Object& b = *objects[pair.second];
    if ((a.unread || b.unread) && filter_.allows(a, b) &&
        lower_distance(a.box, b.box) <= filter_.thresholds(a, b).reach)
      wanted_.insert(wanted_.end(), {&a, &b});
  }
  for (const Key& key : last_keys_)
    for (Object* const object : {object_of(key.first), object_of(key.second)})
      if (object != nullptr && object->unread) wanted_.push_back(object);
  store_.read_unread(wanted_, tasks, diagnostics);
}

void PairTable::list_job(Object& a, Object& b, const PairReport* last, StepStatistics& statistics) {
  PairJob job;
  job.a = &a;
  job.b = &b;
  job.last = last;
  job.thresholds = filter_.thresholds(a, b);
  job.allowed = filter_.allows(a, b);
  if (!job.allowed) ++statistics.pairs_filtered;
  if (!job.allowed && !job.was_in_contact()) return;
  if (!job.allowed) job.task = PairJob::Task::end;
  if (a.frozen || b.frozen) {
    if (last == nullptr) return;
    job.task = PairJob::Task::repeat_last;
  } else {
    const double lower = lower_distance(a.box, b.box);
    // A pair that was in contact is listed once more however far it is now.
    if (!(lower < job.thresholds.reach) && lower > 0 && !job.was_in_contact()) return;
  }
  job.memory = &memories_.of({a.serial, b.serial});
  if (job.task == PairJob::Task::detect && is_unchanged(job)) job.task = PairJob::Task::unchanged;
  if (job.is_looked_at()) ++statistics.pairs_tested;
  jobs_.push_back(job);
}

/// Whether the last answer, about the same positions by the same rules, is also this one's.
bool PairTable::is_unchanged(const PairJob& job) const {
  const PairMemory& memory = *job.memory;
  return memory.version_a == job.a->surface->version() && memory.version_b == job.b->surface->version() &&
         memory.rules_version == filter_.rules_version();
}

void PairTable::was_listed(std::span<const PairJob* const> jobs) {
  last_keys_.clear();
  for (const PairJob* const job : jobs) last_keys_.emplace_back(job->a->serial, job->b->serial);
}

}  // namespace graze
