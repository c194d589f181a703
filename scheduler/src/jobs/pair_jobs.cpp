#include "jobs/pair_jobs.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "core/base/bytes_of.hpp"
#include "core/search/pair_detector.hpp"

namespace graze {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// How many small jobs a task runs. There are enough tasks for any number of threads, and few enough that
/// picking one costs nothing.
std::size_t jobs_of_task(std::size_t jobs) {
  return std::clamp<std::size_t>(jobs / 256, 1, 16);
}

}  // namespace

PairJobs::PairJobs(const SceneSettings& settings, TaskPool& tasks)
    : settings_(settings),
      tasks_(tasks),
      limit_(settings),
      deadline_(settings, limit_, tasks.worker_count()),
      queries_(settings, limit_),
      workers_(settings, limit_, tasks.worker_count()),
      answers_(settings, limit_, deadline_, workers_),
      large_(tasks, queries_, deadline_, answers_, workers_) {}

void PairJobs::run(const PairList& list, std::uint64_t rules_version, StepDeadline::Clock::time_point start,
                   const LastContacts& last, ReportBuilder& report) {
  jobs_ = list.jobs;
  list_tested();
  deadline_.begin(start);
  if (deadline_.is_set()) deadline_.keep_time_back(list.pair_count, repeated_contacts(last), report);
  queries_.begin(list.pair_count);
  workers_.begin();
  answers_.begin(jobs_, rules_version, last, report);
  large_.begin_step();
  if (settings_.time_budget || settings_.work_budget) sort_by_urgency();
  if (settings_.work_budget)
    run_within_work(*settings_.work_budget - std::min(*settings_.work_budget, list.region_pairs_swept));
  else
    settings_.time_budget ? run_by_urgency() : run_group(order_);
  work_.note(workers_.counters(), order_.size());
  answers_.share_contacts();
}

void PairJobs::list_tested() {
  order_.clear();
  for (std::uint32_t index = 0; index < jobs_.size(); ++index)
    if (jobs_[index].is_tested()) order_.push_back(index);
  if (settings_.work_budget) return;  // then there are no groups
  // Any of them may be long, or not.
  for (auto* const list : {&small_jobs_, &long_jobs_}) list->reserve(order_.capacity());
}

/// The number of contacts that the report repeats, since their pairs are not tested.
std::size_t PairJobs::repeated_contacts(const LastContacts& last) const {
  std::size_t contacts = last.report().contacts().size();
  for (const std::uint32_t index : order_)
    if (jobs_[index].last != nullptr) contacts -= jobs_[index].last->contact_count;
  return contacts;
}

// ---- The order of jobs

/// Sorts jobs by urgency: pairs in contact first, then by the lower bound of their distance.
void PairJobs::sort_by_urgency() {
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t left, std::uint32_t right) {
    const auto urgency = [&](std::uint32_t index) {
      const PairJob& job = jobs_[index];
      return std::tuple(!job.was_in_contact(), lower_distance(job.a->box, job.b->box), index);
    };
    return urgency(left) < urgency(right);
  });
}

/// Runs jobs by urgency. A large pair gets all threads when its turn comes, so that no less urgent pair goes
/// first.
void PairJobs::run_by_urgency() {
  const std::span<const std::uint32_t> order(order_);
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    if (!jobs_[order[begin]].is_large())
      while (end < order.size() && !jobs_[order[end]].is_large()) ++end;
    run_group(order.subspan(begin, end - begin));
    begin = end;
  }
}

/// Runs jobs one after the other. Each gets the work that the jobs before it left over, so the answer is the
/// same on any machine.
void PairJobs::run_within_work(std::uint64_t budget) {
  const PairCounters& counters = workers_[0].counters;
  for (const std::uint32_t index : order_) {
    const std::uint64_t before = counters.region_pairs_tested;
    detect(index, 0, budget);
    budget -= std::min(budget, counters.region_pairs_tested - before);
  }
  workers_.end_round(0);
}

// ---- The jobs

/// Runs the small pairs, most of them in batches, while the large ones begin, then runs the slices of the
/// large ones.
///
/// A task writes the answers, fronts and memories of its own jobs, and the memory of its own worker. A slice
/// writes its own part of its pair. Surfaces are only read. What all jobs share is written as PairAnswers
/// says. AccessScope checks surfaces, memories and answers in builds with GRAZE_VALIDATE.
void PairJobs::run_group(std::span<const std::uint32_t> jobs) {
  list_group(jobs);
  const std::size_t each = jobs_of_task(small_jobs_.size());
  const std::size_t batches = (small_jobs_.size() + each - 1) / each;
  // Two captures are what std::function holds without an allocation.
  tasks_.run(large_.count() + long_jobs_.size() + batches,
             [this, each](unsigned worker, std::size_t item) {
               if (item < large_.count()) return large_.begin(item, worker);
               item -= large_.count();
               if (item < long_jobs_.size()) return detect(long_jobs_[item], worker, unlimited);
               const std::size_t begin = (item - long_jobs_.size()) * each;
               const std::size_t end = std::min(begin + each, small_jobs_.size());
               for (std::size_t i = begin; i < end; ++i) detect(small_jobs_[i], worker, unlimited);
             },
             {.nanoseconds = work_.nanoseconds_of(jobs.size()),
              .finish = [this](unsigned worker) { workers_.end_round(worker); }});
  large_.run_slices();
}

bool PairJobs::is_long(const PairJob& job) const {
  return !settings_.time_budget && work_.is_long(job.memory->nanoseconds);
}

/// Large pairs come first, then small ones that took long in the last step, the longest first. So no worker
/// begins a long job when the others are done. With a time budget only urgency counts.
void PairJobs::list_group(std::span<const std::uint32_t> jobs) {
  small_jobs_.clear();
  long_jobs_.clear();
  large_.begin_group();
  for (const std::uint32_t index : jobs) {
    const PairJob& job = jobs_[index];
    if (job.is_large())
      large_.add(index, job);
    else
      (is_long(job) ? long_jobs_ : small_jobs_).push_back(index);
  }
  std::sort(long_jobs_.begin(), long_jobs_.end(), [&](std::uint32_t left, std::uint32_t right) {
    return std::tuple(-jobs_[left].memory->nanoseconds, left) <
           std::tuple(-jobs_[right].memory->nanoseconds, right);
  });
}

void PairJobs::detect(std::uint32_t index, unsigned worker, std::uint64_t work_limit) {
  const PairJob& job = jobs_[index];
  const AccessScope access({AccessRight::read(), AccessRight::write(&job)});
  const Surface& a = job.a->surface();
  const Surface& b = job.b->surface();
  std::optional<FeatureFilter> filter;
  PairQuery query = queries_.of(job, filter);
  query.work_limit = work_limit;
  deadline_.limit(query);
  JobWorker& own = workers_[worker];
  PairAnswer& answer = answers_.answer_for(index, own);
  answers_.lend_to(index, answer);
  if (work_limit == 0 || deadline_.is_late()) {
    PairDetector::outer_bounds(a, b, query, answer);
  } else {
    LeafFront& front = job.memory_to_write().front;
    own.front_bytes -= front.byte_count();
    const double before = JobWork::nanoseconds_of(own.counters);
    own.detector.detect(a, b, query, front, answer, own.counters);
    job.memory_to_write().nanoseconds = static_cast<float>(JobWork::nanoseconds_of(own.counters) - before);
    own.front_bytes += front.byte_count();
    answers_.complete(index, query, answer, own);
    if (query.region_distance_limit > 0) own.detector.region_distances(a, b, query, answer);
  }
  require_write(StepData::pairs, &job);
  answers_.keep(index, answer, worker);
}

// ---- Memory

bool PairJobs::equalize_capacity() {
  answers_.grow_to_demand();
  deadline_.owe_capacity(true);  // stays so if there is no time or no memory
  if (!workers_.equalize_capacity(deadline_)) return false;
  const bool is_over = deadline_.is_over();  // then the reports have no time left either
  deadline_.owe_capacity(is_over);
  return !is_over;
}

void PairJobs::reserve(std::size_t jobs, std::size_t contacts) {
  order_.reserve(jobs);
  small_jobs_.reserve(jobs);
  long_jobs_.reserve(jobs);
  answers_.reserve(jobs, contacts);
  workers_.reserve(contacts);
}

std::size_t PairJobs::byte_count() const {
  return bytes_of(order_) + bytes_of(small_jobs_) + bytes_of(long_jobs_) + answers_.byte_count() +
         large_.byte_count() + workers_.front_bytes();
}

}  // namespace graze
