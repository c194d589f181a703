#include "step.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace graze {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

/// The end of a budget that began at `start`; no deadline where the clock cannot say it.
std::chrono::steady_clock::time_point deadline_of(std::chrono::steady_clock::time_point start,
                                                  std::optional<std::chrono::microseconds> budget) {
  // Compared in microseconds: a nanosecond clock overflows on the largest of them.
  const auto longest = std::chrono::floor<std::chrono::microseconds>(PairQuery::no_deadline - start);
  if (!budget || *budget >= longest) return PairQuery::no_deadline;
  return start + *budget;
}

/// Pairs of leaves in the fronts of all pairs of objects together, 8 bytes each.
constexpr std::size_t front_pairs_of_all = std::size_t{1} << 22;

/// Bounds of regions are made anew when vertices may have moved by this part of a leaf's size.
constexpr double stale_leaf_sizes = 0.25;

/// How loose a front is made: it lasts for some steps of the last motion, but is not so loose that it lists
/// much that is not near.
double slack_of(const Surface& a, const Surface& b) {
  const double leaf = std::min(a.leaf_size(), b.leaf_size());
  const double motion = a.displacement() + b.displacement();
  constexpr double steps = 6;
  constexpr double least_leaf_sizes = 1.0 / 64;
  constexpr double most_leaf_sizes = 0.5;
  if (motion > most_leaf_sizes * leaf) return 0;
  return std::clamp(steps * motion, least_leaf_sizes * leaf, most_leaf_sizes * leaf);
}

/// Milliseconds since the last call, or since it was made.
class Lap {
 public:
  explicit Lap(std::chrono::steady_clock::time_point start) : last_(start) {}
  double operator()() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_;
};

}  // namespace

Step::Step(const SceneSettings& settings, Staging& staging)
    : settings_(settings),
      staging_(staging),
      tasks_(settings.threads),
      filter_(settings),
      detectors_(tasks_.worker_count()),
      counters_(tasks_.worker_count()) {}

void Step::run(std::uint64_t frame, const FrameReport& previous, FrameReport& report) {
  const Clock::time_point start = Clock::now();
  Lap lap(start);
  ReportBuilder builder(report);
  builder.begin(frame);
  StepStatistics& statistics = builder.statistics();

  take_up_calls(builder.diagnostics());
  store_.read_positions(tasks_, builder.diagnostics());
  statistics.read_ms = lap();
  list_jobs(previous, builder);
  statistics.pairs_ms = lap();
  refit();
  statistics.refit_ms = lap();
  run_jobs(start);
  statistics.jobs_ms = lap();
  write_pairs(previous, builder);
  sum_counters(statistics);
  statistics.report_bytes = builder.byte_count();
  statistics.publish_ms = lap();
  statistics.step_ms = Lap(start)();
}

void Step::take_up_calls(std::vector<Diagnostic>& diagnostics) {
  staging_.take(commands_);
  for (Command& command : commands_)
    std::visit(
        Overloaded{[&](Diagnostic& diagnostic) { diagnostics.push_back(std::move(diagnostic)); },
                   [&](SetRule& rule) { filter_.set_rule(rule.kind_a, rule.kind_b, std::move(rule.rule)); },
                   [&](IgnorePair& pair) {
                     const Object* const a = store_.find(pair.a);
                     const Object* const b = store_.find(pair.b);
                     if (a != nullptr && b != nullptr) filter_.set_ignored(*a, *b, pair.ignored);
                   },
                   [&](RemoveObject& removed) {
                     if (const Object* const object = store_.find(removed.object)) filter_.forget(*object);
                     store_.apply(removed);
                   },
                   [&](auto& other) { store_.apply(other); }},
        command);
}

Object* Step::object_of(std::uint64_t serial) const {
  const auto objects = store_.objects();
  const auto found = std::lower_bound(
      objects.begin(), objects.end(), serial,
      [](const std::unique_ptr<Object>& object, std::uint64_t wanted) { return object->serial < wanted; });
  return found != objects.end() && (*found)->serial == serial ? found->get() : nullptr;
}

/// Merges the pairs that the broad phase finds with those of the last report that were in contact or are
/// frozen: both are sorted by the order of addition, and so are the jobs.
void Step::list_jobs(const FrameReport& previous, ReportBuilder& builder) {
  StepStatistics& statistics = builder.statistics();
  const auto objects = store_.objects();
  statistics.objects = objects.size();
  statistics.pairs_total = objects.empty() ? 0 : std::uint64_t{objects.size()} * (objects.size() - 1) / 2;
  jobs_.clear();
  memories_.begin();
  const auto found = broad_phase_.find(objects, filter_.largest_reach());
  read_what_is_near(found, builder.diagnostics());
  auto pair = found.begin();
  std::size_t last = 0;
  const auto key_of = [&](const ObjectPair& indices) {
    return PairKey{objects[indices.first]->serial, objects[indices.second]->serial};
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
}

/// A pair of which one object was not read, because of a promise, is near only where the boxes of what was
/// promised are; then it is read after all. So is what the last report listed, since that has to be said of
/// it again.
void Step::read_what_is_near(std::span<const ObjectPair> pairs, std::vector<Diagnostic>& diagnostics) {
  const auto objects = store_.objects();
  wanted_.clear();
  for (const ObjectPair& pair : pairs) {
    Object& a = *objects[pair.first];
    Object& b = *objects[pair.second];
    if ((a.unread || b.unread) && filter_.allows(a, b) &&
        lower_distance(a.box, b.box) <= filter_.thresholds(a, b).reach)
      wanted_.insert(wanted_.end(), {&a, &b});
  }
  for (const PairKey& key : last_keys_)
    for (Object* const object : {object_of(key.first), object_of(key.second)})
      if (object != nullptr && object->unread) wanted_.push_back(object);
  store_.read_unread(wanted_, tasks_, diagnostics);
}

void Step::list_job(Object& a, Object& b, const PairReport* last, StepStatistics& statistics) {
  Job job{Job::Task::detect, &a, &b, last, nullptr, filter_.thresholds(a, b)};
  const bool allowed = filter_.allows(a, b);
  if (!allowed) ++statistics.pairs_filtered;
  if (!allowed && !job.was_in_contact()) return;
  if (!allowed) job.task = Job::Task::end;
  if (a.frozen || b.frozen) {
    if (last == nullptr) return;
    job.task = Job::Task::repeat_last;
  } else {
    const double lower = lower_distance(a.box, b.box);
    // A pair that was in contact is listed once more however far it is now.
    if (!(lower < job.thresholds.reach) && lower > 0 && !job.was_in_contact()) return;
  }
  job.memory = &memories_.of({a.serial, b.serial});
  if (job.task == Job::Task::detect && is_unchanged(job)) job.task = Job::Task::unchanged;
  if (job.is_looked_at()) ++statistics.pairs_tested;
  jobs_.push_back(job);
}

/// Whether the last answer, about the same positions by the same rules, is also this one's.
bool Step::is_unchanged(const Job& job) const {
  const PairMemory& memory = *job.memory;
  return memory.version_a == job.a->surface->version() && memory.version_b == job.b->surface->version() &&
         memory.rules_version == filter_.rules_version();
}

PairQuery Step::query_of(const Job& job) const {
  PairQuery query;
  query.detail = settings_.detail;
  query.mode = settings_.accuracy.mode();
  query.tolerance = settings_.accuracy.tolerance();
  query.epsilon = job.thresholds.epsilon;
  query.threshold = job.thresholds.threshold;
  query.reach = job.thresholds.reach;
  if (job.was_in_contact()) query.reach = infinity;
  query.slack = slack_of(*job.a->surface, *job.b->surface);
  query.front_limit = front_pairs_of_all / jobs_.size();
  if (job.task == Job::Task::end) {
    query.threshold = 0;
    if (!is_about_vertices(query.detail)) query.detail = ContactDetail::none;
  }
  return query;
}

void Step::refit() {
  to_refit_.clear();
  for (const Job& job : jobs_)
    if (job.is_looked_at()) to_refit_.insert(to_refit_.end(), {job.a, job.b});
  std::sort(to_refit_.begin(), to_refit_.end(),
            [](const Object* left, const Object* right) { return left->serial < right->serial; });
  to_refit_.erase(std::unique(to_refit_.begin(), to_refit_.end()), to_refit_.end());
  tasks_.run(to_refit_.size(), [&](unsigned, std::size_t index) {
    Surface& surface = *to_refit_[index]->surface;
    const bool about_vertices = is_about_vertices(settings_.detail);
    const double motion =
        about_vertices ? surface.motion_since_vertex_refit() : surface.motion_since_face_refit();
    const bool to_the_letter = settings_.accuracy.mode() == AccuracyMode::paper;
    if (!to_the_letter && motion <= stale_leaf_sizes * surface.leaf_size()) return;
    about_vertices ? surface.refit_vertices() : surface.refit_faces();
  });
}

void Step::run_jobs(Clock::time_point start) {
  if (answers_.size() < jobs_.size()) answers_.resize(jobs_.size());
  std::fill(counters_.begin(), counters_.end(), PairCounters{});
  const Clock::time_point deadline = deadline_of(start, settings_.time_budget);
  if (settings_.time_budget || settings_.work_budget) sort_by_urgency();
  if (settings_.work_budget) return run_within_work(*settings_.work_budget, deadline);
  // A task writes the answers of its own jobs, and the detector and counters of its own worker. Surfaces and
  // the filter are only read.
  tasks_.run(jobs_.size(), [&](unsigned worker, std::size_t item) {
    detect(settings_.time_budget ? urgent_[item] : item, worker, unlimited, deadline);
  });
}

void Step::detect(std::size_t index, unsigned worker, std::uint64_t work_limit, Clock::time_point deadline) {
  const Job& job = jobs_[index];
  if (!job.is_looked_at()) return;
  PairQuery query = query_of(job);
  query.work_limit = work_limit;
  query.deadline = deadline;
  const Surface& a = *job.a->surface;
  const Surface& b = *job.b->surface;
  if (work_limit == 0 || (deadline != PairQuery::no_deadline && Clock::now() >= deadline))
    return PairDetector::outer_bounds(a, b, query, answers_[index]);
  PairMemory& memory = *job.memory;
  detectors_[worker].detect(a, b, query, memory.front, answers_[index], counters_[worker]);
  const bool whole = answers_[index].complete && job.task == Job::Task::detect;
  memory.version_a = whole ? a.version() : 0;
  memory.version_b = whole ? b.version() : 0;
  memory.rules_version = filter_.rules_version();
}

/// In contact first, then the smallest lower bound.
void Step::sort_by_urgency() {
  urgent_.resize(jobs_.size());
  std::vector<std::tuple<bool, double, std::uint32_t>> order;
  order.reserve(jobs_.size());
  for (std::uint32_t index = 0; index < jobs_.size(); ++index)
    order.emplace_back(!jobs_[index].was_in_contact(),
                       lower_distance(jobs_[index].a->box, jobs_[index].b->box), index);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) urgent_[i] = std::get<2>(order[i]);
}

/// One after the other: what a pair leaves of the budget is for the next, so the answer is the same on any
/// machine.
void Step::run_within_work(std::uint64_t budget, Clock::time_point deadline) {
  for (const std::uint32_t index : urgent_) {
    const std::uint64_t before = counters_[0].region_pairs_tested;
    detect(index, 0, budget, deadline);
    budget -= std::min(budget, counters_[0].region_pairs_tested - before);
  }
}

std::optional<PairReport> Step::repeated_row(const Job& job) {
  if (job.last == nullptr) return std::nullopt;
  PairReport row = *job.last;
  row.stale = job.task == Job::Task::repeat_last;
  if (row.phase == PairPhase::began) row.phase = PairPhase::touching;
  if (row.phase != PairPhase::ended) return row;
  row.phase = PairPhase::near;
  if (row.distance.lower < job.thresholds.reach) return row;
  return std::nullopt;
}

std::optional<PairReport> Step::row_of(const Job& job, const PairAnswer& answer) {
  const bool was = job.was_in_contact();
  PairReport row;
  row.a = job.a->id;
  row.b = job.b->id;
  row.complete = answer.complete;
  row.distance = answer.distance;
  row.witness = answer.witness;
  if (job.task == Job::Task::end)
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

/// The serial end of a step: jobs ran in any order, but their answers are put together in the order of the
/// pairs.
void Step::write_pairs(const FrameReport& previous, ReportBuilder& builder) {
  keys_.clear();
  StepStatistics& statistics = builder.statistics();
  for (std::size_t index = 0; index < jobs_.size(); ++index) {
    const Job& job = jobs_[index];
    const bool repeats = !job.is_looked_at();
    std::optional<PairReport> row = repeats ? repeated_row(job) : row_of(job, answers_[index]);
    if (!row) continue;
    if (repeats && !filter_.allows(*job.a, *job.b)) row->phase = PairPhase::ended;
    const bool in_contact = row->phase == PairPhase::began || row->phase == PairPhase::touching;
    std::span<const Contact> contacts;
    if (in_contact)
      contacts = repeats ? previous.contacts(*job.last) : std::span<const Contact>(answers_[index].contacts);
    builder.add(*row, contacts);
    keys_.emplace_back(job.a->serial, job.b->serial);
    ++statistics.pairs_near;
    if (in_contact) ++statistics.pairs_in_contact;
    statistics.contacts += contacts.size();
  }
  last_keys_.swap(keys_);
}

void Step::sum_counters(StepStatistics& statistics) {
  PairCounters sum;
  for (const PairCounters& counters : counters_) sum.add(counters);
  statistics.region_pairs_tested = sum.region_pairs_tested;
  statistics.leaf_pairs_tested = sum.leaf_pairs_tested;
  statistics.discarded_in_float = sum.discarded_in_float;
  statistics.decided_in_double = sum.decided_in_double;
  statistics.exact_decisions = sum.exact_decisions;
  statistics.regions_expanded = sum.regions_expanded;
  for (const auto& object : store_.objects()) {
    statistics.object_bytes += object->surface->byte_count();
    statistics.objects_unread += object->unread ? 1U : 0U;
  }
  statistics.pair_bytes = memories_.byte_count();
}

}  // namespace graze
