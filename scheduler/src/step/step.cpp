#include "step/step.hpp"

#include <array>
#include <new>
#include <utility>

#include "step/call_applier.hpp"

namespace graze {
namespace {

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

}  // namespace

Step::Step(const SceneSettings& settings, SceneContent& content, Staging& staging, ReportPool& reports)
    : staging_(staging),
      reports_(reports),
      tasks_(content.tasks),
      store_(content.store),
      pairs_(settings, content.filter, store_),
      refit_(settings, tasks_, store_.bytes()),
      sweeps_(settings, tasks_, store_.bytes()),
      jobs_(settings, tasks_),
      rows_(tasks_, store_, pairs_, jobs_, sweeps_, last_contacts_),
      reserve_(settings, content, reports, pairs_, refit_, sweeps_, jobs_, rows_),
      geometry_(tasks_, store_),
      meshes_(store_),
      patches_(tasks_, store_) {}

void Step::run(const FrameReport& previous, FrameReport& report, FrameCapture* capture, GhostSource* ghosts) {
  const Clock::time_point start = Clock::now();
  Lap lap(start);
  ReportBuilder builder(report);
  StepStatistics& statistics = builder.statistics();

  apply_calls(builder.diagnostics(), capture);
  store_.read_positions(tasks_, builder.diagnostics(), capture);
  if (ghosts != nullptr) {
    ghosts->bring(store_, pairs_.filter(), tasks_);
    can_repeat_report_ = false;
  }
  builder.set_geometry(geometry_.keep());
  builder.set_meshes(meshes_.keep());
  statistics.times.read_ms = lap();
  if (std::exchange(can_repeat_report_, false) && !store_.changed()) {
    repeat_rows(previous, statistics);
    builder.set_patches(patches_.last());
  } else {
    PairList list = pairs_.list(previous, patches_.tools(), tasks_, builder.diagnostics(), statistics);
    statistics.times.pairs_ms = lap();
    refit_.run(list.jobs);
    builder.set_patches(patches_.keep(pairs_.summaries(), pairs_.filter()));
    statistics.times.refit_ms = lap();
    if (store_.swept().some()) sweep(list, start, statistics);
    last_contacts_.begin(previous, list.jobs, store_.some_replaced());
    jobs_.run(list, pairs_.filter().rules_version(), start, last_contacts_, builder);
    statistics.times.jobs_ms = lap();
    can_repeat_report_ = rows_.write(list, previous, builder);
    sum_counters(statistics);
    equalize_capacity();
    count_bytes_of_pairs(statistics);
  }
  statistics.objects_unread = store_.unread_count();
  statistics.objects_surveyed = store_.surveyed_count();
  statistics.bytes.objects = store_.byte_count() + staging_.byte_count();
  statistics.bytes.reports =
      reports_.byte_count() + geometry_.byte_count() + meshes_.byte_count() + patches_.byte_count();
  store_.forget_replaced();
  store_.forget_departed();  // the report is made: nothing throws from here on
  statistics.times.publish_ms = lap();
  statistics.times.step_ms = Lap(start)();
}

void Step::apply_calls(std::vector<Diagnostic>& diagnostics, FrameCapture* capture) {
  CallApplier applier(store_, pairs_.filter(), reserve_, diagnostics);
  const auto apply = [&](auto& call) { applier(call); };
  if (capture == nullptr) {
    staging_.visit_collected(apply);
  } else {
    capture->begin_step(store_, pairs_.filter());
    staging_.visit_collected([&](auto& call) { capture->see(call, [&] { apply(call); }); });
    capture->see_content(pairs_.filter());
  }
  if (applier.concerns_pairs()) can_repeat_report_ = false;
}

/// Sweeps the pairs that may meet between the last step and this one.
void Step::sweep(PairList& list, Clock::time_point start, StepStatistics& statistics) {
  sweeps_.run(pairs_.jobs(), store_.swept(), start);
  const SweepWork work = sweeps_.work();
  list.region_pairs_swept = work.region_pairs_tested;
  statistics.pairs_swept = sweeps_.count();
  statistics.work.swept_region_pairs = work.region_pairs_tested;
  statistics.work.swept_feature_pairs = work.feature_pairs_tested;
  statistics.work.swept_exact_decisions = work.features.exact;
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
void Step::equalize_capacity() {
  try {
    if (sweeps_.count() > 0) sweeps_.equalize_capacity();
    reports_.equalize_capacity(jobs_.equalize_capacity());
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
void Step::count_bytes_of_pairs(StepStatistics& statistics) {
  statistics.bytes.pairs = pairs_.byte_count() + refit_.byte_count() + jobs_.byte_count() +
                           rows_.byte_count() + last_contacts_.byte_count() + sweeps_.byte_count();
  statistics.bytes.threads = jobs_.thread_byte_count() + sweeps_.thread_byte_count();
}

}  // namespace graze
