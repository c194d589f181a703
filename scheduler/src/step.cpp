#include "step.hpp"

#include "report_rows.hpp"

namespace graze {
namespace {

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

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
    : staging_(staging),
      tasks_(settings.threads, settings.arena),
      pairs_(settings, store_),
      refit_(settings, tasks_),
      jobs_(settings, tasks_) {}

void Step::run(std::uint64_t frame, const FrameReport& previous, FrameReport& report) {
  const Clock::time_point start = Clock::now();
  Lap lap(start);
  ReportBuilder builder(report);
  builder.begin(frame);
  StepStatistics& statistics = builder.statistics();

  take_up_calls(builder.diagnostics());
  store_.read_positions(tasks_, builder.diagnostics());
  statistics.read_ms = lap();
  const auto jobs = pairs_.list(previous, tasks_, builder.diagnostics(), statistics);
  statistics.pairs_ms = lap();
  refit_.run(jobs);
  statistics.refit_ms = lap();
  jobs_.run(jobs, pairs_.filter().rules_version(), start);
  statistics.jobs_ms = lap();
  write_pairs(jobs, previous, builder);
  sum_counters(jobs, statistics);
  statistics.report_bytes = builder.byte_count();
  statistics.publish_ms = lap();
  statistics.step_ms = Lap(start)();
}

void Step::take_up_calls(std::vector<Diagnostic>& diagnostics) {
  staging_.visit_taken(Overloaded{
      [&](Diagnostic& diagnostic) { diagnostics.push_back(std::move(diagnostic)); },
      [&](SetRule& rule) { pairs_.filter().set_rule(rule.kind_a, rule.kind_b, std::move(rule.rule)); },
      [&](IgnorePair& pair) {
        const Object* const a = store_.find(pair.a);
        const Object* const b = store_.find(pair.b);
        if (a != nullptr && b != nullptr) pairs_.filter().set_ignored(*a, *b, pair.ignored);
      },
      [&](RemoveObject& removed) {
        if (const Object* const object = store_.find(removed.object)) pairs_.filter().forget(*object);
        store_.apply(removed);
      },
      [&](Reserve& reserve) { store_.reserve(reserve.capacity.objects); },
      [&](auto& other) { store_.apply(other); }});
}

/// The serial end of a step: jobs ran in any order, but their answers are put together in the order of the
/// pairs.
void Step::write_pairs(std::span<const PairJob> jobs, const FrameReport& previous, ReportBuilder& builder) {
  StepStatistics& statistics = builder.statistics();
  for (std::size_t index = 0; index < jobs.size(); ++index) {
    const PairJob& job = jobs[index];
    const bool repeats = !job.is_looked_at();
    std::optional<PairReport> row = repeats ? repeated_row(job) : row_of(job, jobs_.answer(index));
    if (!row) continue;
    if (repeats && !job.allowed) row->phase = PairPhase::ended;
    const bool in_contact = row->phase == PairPhase::began || row->phase == PairPhase::touching;
    const PairAnswer& answer = jobs_.answer(index);
    std::span<const Contact> contacts;
    if (in_contact)
      contacts = repeats ? previous.contacts(*job.last) : std::span<const Contact>(answer.contacts);
    const auto regions = repeats ? previous.region_distances(*job.last)
                                 : std::span<const RegionDistance>(answer.region_distances);
    const auto reported = builder.add(*row, contacts, regions);
    statistics.region_distances += regions.size();
    if (!repeats) statistics.region_distances_left_out += answer.region_distances_left_out;
    if (job.last != nullptr && !row->stale) set_ages(previous.contacts(*job.last), reported);
    ++statistics.pairs_near;
    if (in_contact) ++statistics.pairs_in_contact;
    statistics.contacts += contacts.size();
  }
}

void Step::sum_counters(std::span<const PairJob> jobs, StepStatistics& statistics) {
  const PairCounters sum = jobs_.counters();
  statistics.region_pairs_tested = sum.region_pairs_tested;
  statistics.leaf_pairs_tested = sum.leaf_pairs_tested;
  statistics.discarded_in_float = sum.discarded_in_float;
  statistics.decided_in_double = sum.decided_in_double;
  statistics.exact_decisions = sum.exact_decisions;
  statistics.fronts_left_out = sum.fronts_left_out;
  statistics.regions_expanded = sum.regions_expanded;
  // Only what a job looked at may have got memory for its regions.
  for (const PairJob& job : jobs)
    for (Object* const object : {job.a, job.b}) store_.count_bytes(*object);
  statistics.object_bytes = store_.byte_count();
  statistics.objects_unread = store_.unread_count();
  statistics.pair_bytes = pairs_.byte_count();
}

}  // namespace graze
