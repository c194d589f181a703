#include "jobs/step_deadline.hpp"

namespace graze {
namespace {

// The time of a budget that is kept back for writing rows and contacts after the jobs. The numbers were
// measured and have a safety margin.
constexpr std::chrono::nanoseconds after_each_pair{150};
constexpr std::chrono::nanoseconds after_each_contact{60};
constexpr std::chrono::microseconds after_all{50};

/// A step keeps back 1 in this many parts of its time budget if the last step had no time left to equalize
/// capacity.
constexpr int part_for_room = 5;

/// The end of a budget that began at `start`, or no deadline if the clock cannot represent it.
StepDeadline::Clock::time_point end_of(StepDeadline::Clock::time_point start,
                                       std::optional<std::chrono::microseconds> budget) {
  // This compares microseconds, since a clock in nanoseconds overflows for the largest budgets.
  const auto longest = std::chrono::floor<std::chrono::microseconds>(PairQuery::no_deadline - start);
  if (!budget || *budget >= longest) return PairQuery::no_deadline;
  return start + *budget;
}

}  // namespace

void StepDeadline::begin(Clock::time_point start) {
  end_ = without_found_ = end_of(start, settings_.time_budget);
  found_.store(0, std::memory_order_relaxed);
}

void StepDeadline::keep_time_back(std::size_t pairs, std::size_t contacts, ReportBuilder& report) {
  without_found_ = end_ - after_all - pairs * after_each_pair - contacts * after_each_contact;
  if (owes_capacity_) without_found_ -= *settings_.time_budget / part_for_room;
  report_ = &report;
  contacts_with_room_ = contacts;
}

/// The deadline less the time in which all threads together will write the contacts found so far.
StepDeadline::Clock::time_point StepDeadline::now() const {
  if (!is_set()) return end_;
  return without_found_ - found_.load(std::memory_order_relaxed) * after_each_contact / workers_;
}

void StepDeadline::limit(PairQuery& query) const {
  query.deadline = now();
  query.time_after_contact = after_each_contact;
}

/// The first write to new memory costs many times more than later writes. So the report touches it before
/// the deadline, piece by piece. If there is no time for it now, the next steps have time for it.
bool StepDeadline::make_room(std::size_t contacts) {
  if (!is_set() || contacts == 0) return true;
  const std::lock_guard lock(mutex_);
  contacts = contacts_.of_further(contacts, contacts_with_room_);
  if (!report_->make_room_while(contacts_with_room_ + contacts, [&] { return !is_late(); })) return false;
  contacts_with_room_ += contacts;
  found_.fetch_add(contacts, std::memory_order_relaxed);
  return true;
}

}  // namespace graze
