#include "step/step.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "step/report_rows.hpp"

namespace graze {
namespace {

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

/// A reserved pair's list has room for this many pairs of features for each of its share of the contacts;
/// SceneCapacity states it.
constexpr std::size_t features_of_contact = 4;

PairMemoryRoom room_for(const SceneCapacity& capacity, ContactDetail detail) {
  const bool has_lists = lists_piercings(detail) || detail == ContactDetail::vertices;
  const std::size_t contacts = capacity.contacts / capacity.near_pairs + 1;
  return {leaf_pairs_of_front, has_lists ? features_of_contact * contacts : 0};
}

/// A clock that returns the milliseconds since its last call, or since it was made.
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

bool is_nothing(const SceneCapacity& capacity) {
  return capacity.objects == 0 && capacity.near_pairs == 0 && capacity.contacts == 0 && capacity.reports == 0;
}

/// The larger of each two numbers.
SceneCapacity both(const SceneCapacity& left, const SceneCapacity& right) {
  return {std::max(left.objects, right.objects), std::max(left.calls_per_step, right.calls_per_step),
          std::max(left.near_pairs, right.near_pairs), std::max(left.contacts, right.contacts),
          std::max(left.reports, right.reports)};
}

}  // namespace

Step::Step(const SceneSettings& settings, SceneContent& content, Staging& staging, ReportPool& reports)
    : settings_(settings),
      content_(content),
      staging_(staging),
      reports_(reports),
      tasks_(content.tasks),
      store_(content.store),
      pairs_(settings, content.filter, store_),
      refit_(settings, tasks_),
      jobs_(settings, tasks_) {}

void Step::run(const FrameReport& previous, FrameReport& report, FrameCapture* capture) {
  const Clock::time_point start = Clock::now();
  Lap lap(start);
  ReportBuilder builder(report);
  StepStatistics& statistics = builder.statistics();

  apply_calls(builder.diagnostics(), capture);
  store_.read_positions(tasks_, builder.diagnostics(), capture);
  statistics.times.read_ms = lap();
  if (std::exchange(can_repeat_report_, false) && !store_.changed()) {
    repeat_rows(previous, statistics);
  } else {
    const PairList list = pairs_.list(previous, tasks_, builder.diagnostics(), statistics);
    statistics.times.pairs_ms = lap();
    refit_.run(list.jobs);
    statistics.times.refit_ms = lap();
    last_contacts_.begin(previous, list.jobs, store_.some_replaced());
    jobs_.run(list, pairs_.filter().rules_version(), start, last_contacts_, builder);
    statistics.times.jobs_ms = lap();
    write_pairs(list, previous, builder);
    sum_counters(statistics);
    equalize_capacity(start);
    count_bytes_of_pairs(list.jobs, statistics);
  }
  statistics.objects_unread = store_.unread_count();
  statistics.objects_surveyed = store_.surveyed_count();
  statistics.bytes.objects = store_.byte_count() + staging_.byte_count();
  statistics.bytes.reports = reports_.byte_count();
  store_.forget_replaced();
  store_.forget_departed();  // the report is made: nothing throws from here on
  statistics.times.publish_ms = lap();
  statistics.times.step_ms = Lap(start)();
}

void Step::apply_calls(std::vector<Diagnostic>& diagnostics, FrameCapture* capture) {
  const Overloaded apply{[&](Diagnostic& diagnostic) { diagnostics.push_back(std::move(diagnostic)); },
                         [&](SetRule& rule) {
                           pairs_.filter().set_rule(rule.kind_a, rule.kind_b, std::move(rule.rule));
                           can_repeat_report_ = false;
                         },
                         [&](IgnorePair& pair) {
                           can_repeat_report_ = false;
                           Object* const a = store_.find(pair.a);
                           Object* const b = store_.find(pair.b);
                           if (a != nullptr && b != nullptr)
                             pairs_.filter().set_ignored(*a, *b, pair.ignored);
                         },
                         [&](IgnoreGroups& groups) { set_ignored(groups); },
                         [&](RemoveObject& removed) {
                           if (Object* const object = store_.find(removed.object))
                             pairs_.filter().forget(*object);
                           store_.apply(removed);
                         },
                         [&](RefusePose& refused) {
                           diagnostics.push_back(refused.problem);
                           store_.apply(refused);
                         },
                         [&](BindPositions& bound) {
                           store_.apply(bound);
                           Object* const object = store_.find(bound.object);
                           if (is_reserved_ && object != nullptr) prepare_copy(*object);
                         },
                         [&](UnbindPositions& call) { store_.apply(call, diagnostics); },
                         [&](Reserve& call) {
                           can_repeat_report_ =
                               false;  // a step that repeats rows does not count what is made room for
                           // If there is no memory for it, it is not tried again: the scene does without it.
                           reserve(std::exchange(call.capacity, {}));
                         },
                         [&](AddObject& added) {
                           if (is_reserved_) prepare_surface(*added.surface, added.settings);
                           store_.apply(added);
                         },
                         [&](ReplaceMesh& call) {
                           const Object* const object = store_.find(call.object);
                           if (is_reserved_ && object != nullptr)
                             prepare_surface(*call.surface, object->settings);
                           if (object != nullptr) pairs_.filter().regroup(*object, call.face_groups);
                           store_.apply(call);
                         },
                         [&](auto& other) { store_.apply(other); }};
  if (capture == nullptr) return staging_.visit_collected(apply);
  capture->begin_step(store_, pairs_.filter());
  staging_.visit_collected([&](auto& call) { capture->see(call, [&] { apply(call); }); });
  capture->see_content(pairs_.filter());
}

void Step::set_ignored(const IgnoreGroups& groups) {
  can_repeat_report_ = false;
  const Object* const a = store_.find(groups.a);
  const Object* const b = store_.find(groups.b);
  if (a != nullptr && b != nullptr)
    pairs_.filter().set_ignored(*a, groups.group_a, *b, groups.group_b, groups.ignored);
}

void Step::reserve(const SceneCapacity& capacity) {
  if (is_nothing(capacity)) return;
  store_.reserve(capacity.objects);
  reports_.reserve(capacity.reports, {capacity.near_pairs, capacity.contacts,
                                      capacity.near_pairs > 0 ? settings_.region_distances : 0});
  if (capacity.near_pairs > 0) reserve_for_pairs(capacity);
  content_.reserved = both(content_.reserved, capacity);
}

void Step::reserve_for_pairs(const SceneCapacity& capacity) {
  is_reserved_ = true;
  pairs_.reserve(std::max(capacity.objects, store_.objects().size()), capacity.near_pairs,
                 room_for(capacity, settings_.detail));
  refit_.reserve(capacity.near_pairs);
  jobs_.reserve(capacity.near_pairs, capacity.contacts);
  contacts_.reserve(capacity.near_pairs);
  for (const auto& object : store_.objects()) {
    if (object == nullptr) continue;  // removed in this step
    object->end_view();
    prepare_surface(object->surface_to_write(), object->settings);
    store_.count_bytes(*object);
    prepare_copy(*object);
  }
}

/// Prepares an object for its first pair: the bounds of its regions, room for its leaves in working memory,
/// and positions by pose.
void Step::prepare_surface(Surface& surface, const ObjectSettings& settings) {
  if (settings.motion != Motion::deformable) surface.reserve_positions(true);
  refit_.prepare(surface);
  jobs_.reserve_for(surface.mesh(), settings.solid);
  if (settings.solid && !is_about_vertices(settings_.detail)) pairs_.reserve_for_solids();
}

/// Reserves memory for the positions of a bound object, which are copied when it comes near another. An
/// object that can be viewed needs no copy.
void Step::prepare_copy(Object& object) {
  if (!object.bound) return;
  const bool is_viewed = wants_blocks(settings_.detail, settings_.accuracy.mode()) &&
                         settings_.region_distances == 0 && object.surface().can_view(object.bound->view);
  if (is_viewed) return;
  object.surface_to_write().reserve_positions(object.bound->view.is_double());
  store_.count_bytes(object);
}

/// Writes the pairs of the report. Jobs ran in any order, but their answers are written in the order of the
/// pairs.
void Step::write_pairs(const PairList& list, const FrameReport& previous, ReportBuilder& builder) {
  StepStatistics& statistics = builder.statistics();
  rows_again_ = 0;
  contacts_.begin();
  pairs_.begin_rows(builder.frame());
  auto rows = list.last_rows.begin();
  const auto write_rows_before = [&](std::size_t job) {
    for (; rows != list.last_rows.end() && rows->job == job; ++rows)
      rows->ended ? end_pair(previous.pairs()[rows->row], builder) : repeat_pairs(*rows, previous, builder);
  };
  for (std::size_t index = 0; index < list.jobs.size(); ++index) {
    write_rows_before(index);
    write_pair(list.jobs[index], index, previous, builder);
  }
  write_rows_before(list.jobs.size());
  if (std::vector<Contact>* const longest = jobs_.longest_list()) contacts_.adopt_list(*longest, builder);
  contacts_.write(tasks_, builder.contacts(), builder.frame());
  can_repeat_report_ = statistics.pairs_tested == 0 && rows_again_ == statistics.pairs_near;
}

void Step::write_pair(const PairJob& job, std::size_t index, const FrameReport& previous,
                      ReportBuilder& builder) {
  StepStatistics& statistics = builder.statistics();
  const bool repeats = !job.is_tested();
  std::optional<PairReport> row = repeats ? repeated_row(job) : row_of(job, jobs_.answer(index));
  if (!row) return;
  const bool is_of_old_mesh = repeats && store_.some_replaced() && job.speaks_of_replaced();
  if (is_of_old_mesh) row->witness = mapped_witness(job);
  if (repeats && !job.allowed) {
    row->phase = PairPhase::ended;
    row->inside = Inside::none;
    row->way_out = {};
  }
  if (repeats && row->phase == job.last->phase && row->stale == job.last->stale) ++rows_again_;
  const bool in_contact = is_contact(row->phase);
  const KeptAnswer& answer = jobs_.answer(index);
  const auto last = last_contacts_.of(index);
  std::span<const Contact> contacts;
  if (in_contact) contacts = repeats && !settings_.max_contacts ? last : answer.contacts;
  if (settings_.max_contacts && answer.contacts_left_out > 0) row->contacts_cut = true;
  if (row->contacts_cut) row->complete = false;
  repeats ? contacts_.add_again(contacts) : contacts_.add(contacts, last);
  auto regions = repeats ? previous.region_distances(*job.last) : answer.region_distances;
  if (is_of_old_mesh) regions = {};
  builder.add(*row, contacts.size(), regions);
  pairs_.add_row(job);
  statistics.region_distances += regions.size();
  if (!repeats) statistics.region_distances_left_out += answer.region_distances_left_out;
  ++statistics.pairs_near;
  if (in_contact) ++statistics.pairs_in_contact;
  statistics.contacts += contacts.size();
  if (!row->contacts_cut) return;
  ++statistics.pairs_cut;
  const std::size_t left_out = settings_.max_contacts ? answer.contacts_left_out : 0;
  statistics.contacts_left_out += std::max<std::size_t>(left_out, 1);
}

/// Writes the last row of a pair in contact that ends because one of its objects was removed.
void Step::end_pair(PairReport row, ReportBuilder& builder) {
  row.phase = PairPhase::ended;
  row.complete = true;
  row.stale = row.contacts_cut = false;
  row.inside = Inside::none;
  row.way_out = {};
  builder.add(row, 0, {});
  pairs_.pass_row();
  ++builder.statistics().pairs_near;
}

/// Repeats rows of the last report with their contacts and distances of regions.
void Step::repeat_pairs(const LastRows& resting, const FrameReport& previous, ReportBuilder& builder) {
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
    if (!row.contacts_cut) continue;
    ++statistics.pairs_cut;
    ++statistics.contacts_left_out;
  }
}

/// Repeats all rows of the last report, in which no pair was tested.
void Step::repeat_rows(const FrameReport& previous, StepStatistics& statistics) {
  reports_.repeat_rows();
  const double read_ms = statistics.times.read_ms;
  statistics = previous.statistics();
  statistics.times.read_ms = read_ms;
  statistics.times.pairs_ms = statistics.times.refit_ms = statistics.times.jobs_ms = 0;
  // The counters of the broad phase are 0, since it does not run.
  statistics.work.boxes_tested = statistics.objects_in_slack = 0;
  can_repeat_report_ = true;
}

/// Grows capacities so that steps like this one allocate nothing. If memory or the time budget does not
/// suffice, later steps allocate instead. The step's result does not depend on it.
void Step::equalize_capacity(Clock::time_point start) {
  try {
    reports_.equalize_capacity(jobs_.equalize_capacity(start));
  } catch (const std::bad_alloc&) {
    return;
  }
}

namespace {

/// The statistic of a step that holds each counter of the searches.
struct CounterOfStep {
  std::uint64_t PairCounters::*of_pairs;
  std::uint64_t StepWork::*of_step;
};
constexpr std::array counters_of_step{
    CounterOfStep{&PairCounters::region_pairs_tested, &StepWork::region_pairs_tested},
    CounterOfStep{&PairCounters::leaf_pairs_tested, &StepWork::leaf_pairs_tested},
    CounterOfStep{&PairCounters::discarded_in_float, &StepWork::discarded_in_float},
    CounterOfStep{&PairCounters::named_in_float, &StepWork::named_in_float},
    CounterOfStep{&PairCounters::decided_in_double, &StepWork::decided_in_double},
    CounterOfStep{&PairCounters::exact_decisions, &StepWork::exact_decisions},
    CounterOfStep{&PairCounters::fronts_left_out, &StepWork::fronts_left_out},
};
static_assert(sizeof(PairCounters) == counters_of_step.size() * sizeof(std::uint64_t) +
                                          sizeof(PairCounters::pairs_by_list) +
                                          sizeof(PairCounters::regions_expanded),
              "every counter has its statistic");

}  // namespace

void Step::sum_counters(StepStatistics& statistics) {
  const PairCounters sum = jobs_.counters();
  for (const CounterOfStep& counter : counters_of_step)
    statistics.work.*counter.of_step = sum.*counter.of_pairs;
  statistics.work.regions_expanded = sum.regions_expanded;
  statistics.pairs_by_list = sum.pairs_by_list;
}

/// Counts the bytes of pairs. A step that repeats rows changes none of them, and counting would be a third of
/// its work.
void Step::count_bytes_of_pairs(std::span<const PairJob> jobs, StepStatistics& statistics) {
  // Only a job that tested a pair can have allocated memory for its objects' regions.
  for (const PairJob& job : jobs)
    if (job.is_tested())
      for (Object* const object : {job.a, job.b}) store_.count_bytes(*object);
  statistics.bytes.pairs = pairs_.byte_count() + refit_.byte_count() + jobs_.byte_count() +
                           contacts_.byte_count() + last_contacts_.byte_count();
  statistics.bytes.threads = jobs_.thread_byte_count();
}

}  // namespace graze
