#include "jobs/large_pairs.hpp"

#include "core/base/bytes_of.hpp"
#include "core/search/pair_detector.hpp"

namespace graze {

LargePairs::LargePairs(TaskPool& tasks, const PairQueries& queries, const StepDeadline& deadline,
                       PairAnswers& answers, JobWorkers& workers)
    : tasks_(tasks), queries_(queries), deadline_(deadline), kept_(answers), workers_(workers) {}

void LargePairs::begin_step() {
  count_ = answers_of_earlier_groups_ = 0;
}

void LargePairs::begin_group() {
  answers_of_earlier_groups_ += count_;
  count_ = 0;
}

void LargePairs::add(std::uint32_t index, const PairJob& job) {
  if (large_.size() == count_) large_.emplace_back();
  // Answers may move here. The lists of those that were kept do not move with them.
  if (answers_.size() == answers_of_earlier_groups_ + count_) answers_.emplace_back();
  large_[count_].index = index;
  large_[count_].job = &job;
  ++count_;
}

PairAnswer& LargePairs::answer_of(std::size_t index) {
  require_write(StepData::pairs, large_[index].job);
  return answers_[answers_of_earlier_groups_ + index];
}

void LargePairs::begin(std::size_t index, unsigned worker) {
  LargeJob& large = large_[index];
  const PairJob& job = *large.job;
  const AccessScope access({AccessRight::read(), AccessRight::write(&job)});
  const Surface& a = job.a->surface();
  const Surface& b = job.b->surface();
  large.query = queries_.of(job, large.filter);
  deadline_.limit(large.query);
  PairAnswer& answer = answer_of(index);
  large.is_answered = deadline_.is_late();
  if (large.is_answered) {
    PairDetector::outer_bounds(a, b, large.query, answer);
    return kept_.keep_in_place(large.index, answer, worker);
  }
  kept_.lend_to(large.index, answer);
  LeafFront& front = job.memory_to_write().front;
  large.front_bytes = front.byte_count();
  large.pair.begin(a, b, large.query, front, answer);
  advance(index, worker);
}

/// Puts together what the slices of a stage have found, and begins the next stage or keeps the answer.
void LargePairs::advance(std::size_t index, unsigned worker) {
  LargeJob& large = large_[index];
  const PairJob& job = *large.job;
  JobWorker& own = workers_[worker];
  large.is_answered = large.pair.advance(own.detector, own.counters);
  if (!large.is_answered) return;
  PairAnswer& answer = answer_of(index);
  kept_.complete(large.index, large.query, answer, own);
  own.front_bytes += job.memory_to_write().front.byte_count() - large.front_bytes;
  kept_.keep_in_place(large.index, answer, worker);
}

void LargePairs::run_slices() {
  const auto run_slice = [this](unsigned worker, std::size_t item) {
    const Slice& slice = slices_[item];
    const AccessScope access({AccessRight::read(), {}});
    JobWorker& own = workers_[worker];
    large_[slice.large].pair.run_slice(slice.slice, own.detector, own.counters);
  };
  const auto advance_one = [this](unsigned worker, std::size_t index) {
    const AccessScope access({AccessRight::read(), AccessRight::write(large_[index].job)});
    if (!large_[index].is_answered) advance(index, worker);
  };
  const Round round{.finish = [this](unsigned worker) { workers_.end_round(worker); }};
  for (list_slices(); !slices_.empty(); list_slices()) {
    tasks_.run(slices_.size(), run_slice, round);
    tasks_.run(count_, advance_one, round);
  }
}

void LargePairs::list_slices() {
  slices_.clear();
  for (std::uint32_t index = 0; index < count_; ++index)
    if (!large_[index].is_answered)
      for (std::uint32_t slice = 0; slice < large_[index].pair.slice_count(); ++slice)
        slices_.push_back({index, slice});
}

std::size_t LargePairs::byte_count() const {
  std::size_t bytes = bytes_of(large_) + bytes_of(answers_) + bytes_of(slices_);
  for (const LargeJob& large : large_) bytes += large.pair.byte_count();
  for (const PairAnswer& answer : answers_) bytes += bytes_of_lists(answer);
  return bytes;
}

}  // namespace graze
