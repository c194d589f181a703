#pragma once

#include <chrono>
#include <graze/pair_query.hpp>
#include <graze/report.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "broad_phase.hpp"
#include "object_store.hpp"
#include "pair_filter.hpp"
#include "pair_memory.hpp"
#include "report_builder.hpp"
#include "staging.hpp"
#include "task_pool.hpp"

namespace graze {

/// What one step does, and what is kept from step to step. Stepping thread only.
class Step {
 public:
  Step(const SceneSettings& settings, Staging& staging);

  /// Fills `report` with frame `frame`, which follows `previous`.
  void run(std::uint64_t frame, const FrameReport& previous, FrameReport& report);

 private:
  using Clock = std::chrono::steady_clock;
  using PairKey = PairMemories::Key;

  /// What is to be done about one pair.
  struct Job {
    enum class Task : std::uint8_t {
      detect,       ///< look at it
      end,          ///< filtered out while in contact: its distance once more
      repeat_last,  ///< an object is frozen: the last values
      unchanged,    ///< nothing has moved since the last answer: it is this one's too
    };
    Task task = Task::detect;
    Object* a = nullptr;
    Object* b = nullptr;
    const PairReport* last = nullptr;  ///< in the previous report; null where it was not listed
    PairMemory* memory = nullptr;
    PairThresholds thresholds;

    [[nodiscard]] bool is_looked_at() const { return task == Task::detect || task == Task::end; }
    [[nodiscard]] bool was_in_contact() const {
      return last != nullptr && (last->phase == PairPhase::began || last->phase == PairPhase::touching);
    }
  };

  void take_up_calls(std::vector<Diagnostic>& diagnostics);
  void list_jobs(const FrameReport& previous, ReportBuilder& builder);
  void read_what_is_near(std::span<const ObjectPair> pairs, std::vector<Diagnostic>& diagnostics);
  void list_job(Object& a, Object& b, const PairReport* last, StepStatistics& statistics);
  [[nodiscard]] PairQuery query_of(const Job& job) const;
  [[nodiscard]] bool is_unchanged(const Job& job) const;
  [[nodiscard]] Object* object_of(std::uint64_t serial) const;
  void refit();
  void run_jobs(Clock::time_point start);
  void detect(std::size_t index, unsigned worker, std::uint64_t work_limit, Clock::time_point deadline);
  void sort_by_urgency();
  void run_within_work(std::uint64_t budget, Clock::time_point deadline);
  void write_pairs(const FrameReport& previous, ReportBuilder& builder);
  static std::optional<PairReport> row_of(const Job& job, const PairAnswer& answer);
  static std::optional<PairReport> repeated_row(const Job& job);
  void sum_counters(StepStatistics& statistics);

  const SceneSettings& settings_;
  Staging& staging_;
  TaskPool tasks_;
  ObjectStore store_;
  PairFilter filter_;
  BroadPhase broad_phase_;
  PairMemories memories_;
  std::vector<Command> commands_;
  std::vector<PairKey> last_keys_;  ///< of the pairs of the previous report, in its order
  std::vector<PairKey> keys_;
  std::vector<Job> jobs_;
  std::vector<PairAnswer> answers_;    ///< one for each job; kept longer for their memory
  std::vector<std::uint32_t> urgent_;  ///< jobs by urgency
  std::vector<Object*> wanted_;        ///< to be read after all
  std::vector<Object*> to_refit_;
  std::vector<PairDetector> detectors_;  ///< one for each worker
  std::vector<PairCounters> counters_;   ///< likewise
};

}  // namespace graze
