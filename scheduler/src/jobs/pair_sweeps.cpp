#include "jobs/pair_sweeps.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "core/base/bytes_of.hpp"
#include "jobs/pair_queries.hpp"

namespace graze {
namespace {

/// The number of impacts of a pair that each worker reserves. SceneCapacity states it.
constexpr std::size_t reserved_impacts = 1024;
constexpr std::uint64_t any_work = std::numeric_limits<std::uint64_t>::max();

}  // namespace

void PairSweeps::run(std::span<PairJob> jobs, const SweptObjects& objects,
                     std::chrono::steady_clock::time_point start) {
  jobs_ = jobs;
  objects_ = &objects;
  deadline_ = settings_.time_budget ? start + *settings_.time_budget : PairQuery::no_deadline;
  list(jobs);
  for (Worker& worker : workers_) worker.work = {};
  if (swept_.empty()) return;
  make_workers();
  make_boxes(objects);
  if (settings_.work_budget) {
    // One after the other, so that it does not depend on the threads what is left for each.
    for (std::size_t index = 0; index < swept_.size(); ++index) {
      const std::uint64_t used = workers_[0].work.region_pairs_tested;
      sweep(index, 0, *settings_.work_budget - std::min(*settings_.work_budget, used));
    }
  } else {
    tasks_.run(swept_.size(), [this](unsigned worker, std::size_t index) { sweep(index, worker, any_work); });
  }
  for (const SweptJob& pair : swept_) jobs[pair.job].met_on_way = pair.met;
}

void PairSweeps::make_workers() {
  if (workers_.empty()) workers_.resize(tasks_.worker_count());
}

/// Lists the jobs that ask for a sweep, and their objects.
void PairSweeps::list(std::span<const PairJob> jobs) {
  swept_.clear();
  on_the_way_.clear();
  for (std::uint32_t index = 0; index < jobs.size(); ++index) {
    const PairJob& job = jobs[index];
    if (!job.is_swept) continue;
    swept_.emplace_back().job = index;
    for (Object* const object : {job.a, job.b}) {
      if (std::exchange(object->sweep->swept_step, objects_->step()) != objects_->step())
        on_the_way_.push_back(object);
    }
  }
}

void PairSweeps::make_boxes(const SweptObjects& objects) {
  const auto make = [&](unsigned, std::size_t index) {
    Object& object = *on_the_way_[index];
    const AccessScope access({AccessRight::write(&object), {}});
    object.sweep->motion.make_boxes(object.surface(), objects.moves(object));
    bytes_.count(object);
  };
  tasks_.run(on_the_way_.size(), std::cref(make));
}

SweepQuery PairSweeps::query() const {
  SweepQuery query;
  query.precision.tolerance = settings_.sweep_tolerance;
  query.gap = settings_.swept_gap;
  query.impact_limit = limit_.of_impacts();
  query.deadline = deadline_;
  return query;
}

void PairSweeps::sweep(std::size_t index, unsigned worker, std::uint64_t work_limit) {
  SweptJob& pair = swept_[index];
  const PairJob& job = jobs_[pair.job];
  const AccessScope access({AccessRight::read(), {}});
  std::optional<FeatureFilter> filter;
  SweepQuery query = this->query();
  query.groups = groups_of(job, filter);
  query.is_self = job.is_of_self();
  query.work_limit = work_limit;
  Worker& own = workers_[worker];
  const auto way_of = [&](const Object& object) {
    return object.sweep->motion.way(object.surface(), objects_->moves(object));
  };
  own.sweep.sweep(way_of(*job.a), way_of(*job.b), query, own.answer, own.work);
  const SweepAnswer& answer = own.answer;
  const SweepFinding& finding = answer;
  static_cast<SweepFinding&>(pair) = finding;
  pair.met = answer.met();
  pair.impacts = impacts_.keep(answer.impacts, worker);
}

const SweptJob& PairSweeps::of(std::size_t job) const {
  return *std::lower_bound(swept_.begin(), swept_.end(), job,
                           [](const SweptJob& pair, std::size_t value) { return pair.job < value; });
}

SweepWork PairSweeps::work() const {
  SweepWork sum;
  for (const Worker& worker : workers_) sum.add(worker.work);
  return sum;
}

void PairSweeps::reserve(std::size_t objects, std::size_t pairs, std::size_t impacts) {
  swept_.reserve(pairs);
  on_the_way_.reserve(objects);
  impacts_.reserve(impacts);
  make_workers();
  for (Worker& worker : workers_) worker.answer.impacts.reserve(std::min(impacts, reserved_impacts));
  if (!room_) room_.emplace();
}

void PairSweeps::reserve_for(const IndexedMesh& mesh) {
  if (!room_) return;
  room_->include(mesh);
  for (Worker& worker : workers_) worker.sweep.reserve(*room_);
}

void PairSweeps::equalize_capacity() {
  impacts_.grow_to_demand();
  if (workers_.size() < 2) return;
  Worker& first = workers_.front();
  const auto grow = [](Worker& worker, const Worker& other) {
    worker.sweep.reserve_as(other.sweep);
    worker.answer.impacts.reserve(other.answer.impacts.capacity());
  };
  for (const Worker& worker : workers_) grow(first, worker);
  for (Worker& worker : workers_) grow(worker, first);
}

std::size_t PairSweeps::byte_count() const {
  return bytes_of(swept_) + bytes_of(on_the_way_) + impacts_.byte_count();
}

std::size_t PairSweeps::thread_byte_count() const {
  std::size_t bytes = bytes_of(workers_);
  for (const Worker& worker : workers_) bytes += worker.sweep.byte_count() + bytes_of(worker.answer.impacts);
  return bytes;
}

}  // namespace graze
