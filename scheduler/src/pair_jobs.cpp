#include "pair_jobs.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

namespace graze {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

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

}  // namespace

PairJobs::PairJobs(const SceneSettings& settings, TaskPool& tasks)
    : settings_(settings), tasks_(tasks), detectors_(tasks.worker_count()), counters_(tasks.worker_count()) {}

PairQuery PairJobs::query_of(const PairJob& job) const {
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
  if (job.task == PairJob::Task::end) {
    query.threshold = 0;
    if (!is_about_vertices(query.detail)) query.detail = ContactDetail::none;
  }
  return query;
}

void PairJobs::refit(std::span<const PairJob> jobs) {
  to_refit_.clear();
  for (const PairJob& job : jobs)
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

void PairJobs::run(std::span<const PairJob> jobs, std::uint64_t rules_version, Clock::time_point start) {
  jobs_ = jobs;
  rules_version_ = rules_version;
  if (answers_.size() < jobs_.size()) answers_.resize(jobs_.size());
  std::fill(counters_.begin(), counters_.end(), PairCounters{});
  const Clock::time_point deadline = deadline_of(start, settings_.time_budget);
  if (settings_.time_budget || settings_.work_budget) sort_by_urgency();
  if (settings_.work_budget) return run_within_work(*settings_.work_budget, deadline);
  // A task writes the answers of its own jobs, and the detector and counters of its own worker. Surfaces are
  // only read.
  tasks_.run(jobs_.size(), [&](unsigned worker, std::size_t item) {
    detect(settings_.time_budget ? urgent_[item] : item, worker, unlimited, deadline);
  });
}

void PairJobs::detect(std::size_t index, unsigned worker, std::uint64_t work_limit,
                      Clock::time_point deadline) {
  const PairJob& job = jobs_[index];
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
  const bool whole = answers_[index].complete && job.task == PairJob::Task::detect;
  memory.version_a = whole ? a.version() : 0;
  memory.version_b = whole ? b.version() : 0;
  memory.rules_version = rules_version_;
}

/// In contact first, then the smallest lower bound.
void PairJobs::sort_by_urgency() {
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
void PairJobs::run_within_work(std::uint64_t budget, Clock::time_point deadline) {
  for (const std::uint32_t index : urgent_) {
    const std::uint64_t before = counters_[0].region_pairs_tested;
    detect(index, 0, budget, deadline);
    budget -= std::min(budget, counters_[0].region_pairs_tested - before);
  }
}

PairCounters PairJobs::counters() const {
  PairCounters sum;
  for (const PairCounters& counters : counters_) sum.add(counters);
  return sum;
}

}  // namespace graze
