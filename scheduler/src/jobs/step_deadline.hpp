#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <graze/settings.hpp>
#include <mutex>

#include "base/contact_limit.hpp"
#include "core/pair/pair_query.hpp"
#include "report/report_builder.hpp"

namespace graze {

/// Says until when the jobs of a step may run, by its time budget. Without a budget no job is ever late.
///
/// Writing the report takes time after the jobs. So the deadline is earlier than the end of the budget, and
/// each contact that a job finds moves it forward.
///
/// The stepping thread begins a step. While jobs run, any thread may call `is_late`, `limit` and `make_room`:
/// what they read is fixed then, but for an atomic number, and for the report's memory behind a mutex.
class StepDeadline {
 public:
  using Clock = std::chrono::steady_clock;

  StepDeadline(const SceneSettings& settings, const ContactLimit& contacts, unsigned workers)
      : settings_(settings), contacts_(contacts), workers_(workers) {}

  /// Begins a step whose budget began at `start`.
  void begin(Clock::time_point start);
  [[nodiscard]] bool is_set() const { return end_ != PairQuery::no_deadline; }
  /// Keeps time back for writing so many rows and contacts. The jobs make room for further contacts in
  /// `report`. Called where a deadline is set, before the jobs run.
  void keep_time_back(std::size_t pairs, std::size_t contacts, ReportBuilder& report);
  /// Says whether memory is still to be equalized after this step. The next step keeps time back for that.
  void owe_capacity(bool owes) { owes_capacity_ = owes; }
  /// Whether the whole budget is used up.
  [[nodiscard]] bool is_over() const { return is_set() && Clock::now() >= end_; }

  /// Whether no further job may begin.
  [[nodiscard]] bool is_late() const { return is_set() && Clock::now() >= now(); }
  /// Gives a query the deadline.
  void limit(PairQuery& query) const;
  /// Makes room in the report for further contacts, and returns whether there is room for them.
  [[nodiscard]] bool make_room(std::size_t contacts);

 private:
  [[nodiscard]] Clock::time_point now() const;

  const SceneSettings& settings_;
  const ContactLimit& contacts_;
  const unsigned workers_;
  bool owes_capacity_ = false;
  Clock::time_point end_ = PairQuery::no_deadline;  ///< of the budget
  Clock::time_point without_found_ = end_;          ///< the deadline while no contact has been found
  std::atomic<std::size_t> found_{0};               ///< contacts of this step's jobs, if there is a deadline
  std::mutex mutex_;                                ///< guards the two below while jobs run
  ReportBuilder* report_ = nullptr;
  std::size_t contacts_with_room_ = 0;  ///< in the report
};

}  // namespace graze
