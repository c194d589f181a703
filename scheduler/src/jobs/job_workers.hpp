#pragma once

#include <cstddef>
#include <deque>
#include <graze/settings.hpp>
#include <span>
#include <vector>

#include "base/contact_limit.hpp"
#include "core/base/bytes_of.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/carrying.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_counters.hpp"
#include "core/search/pair_detector.hpp"
#include "jobs/step_deadline.hpp"

namespace graze {

/// The bytes held by the lists of an answer.
[[nodiscard]] inline std::size_t bytes_of_lists(const PairAnswer& answer) {
  return bytes_of(answer.contacts) + bytes_of(answer.region_distances);
}

/// The working memory of one worker. While jobs run only this worker touches it, and it runs one task at a
/// time.
struct JobWorker {
  PairDetector detector;
  PairCounters counters;
  CarryingChoice carrying;
  PairAnswer answer;                ///< the answer of the current job
  std::deque<PairAnswer> too_long;  ///< unexpectedly long answers of this step, which are not copied
  /// The bytes by which fronts have grown since the scene began. Only the sum over all workers means
  /// something, since one worker may shrink a front that another has made grow.
  std::size_t front_bytes = 0;
  std::size_t bytes = 0;        ///< that the lists of this worker hold, as of `count_bytes`
  std::size_t equal_bytes = 0;  ///< the same, when the capacities of all workers were made equal

  /// Counts the bytes of all lists. It takes some microseconds.
  void count_bytes();
  void reserve_as(const JobWorker& other);
  void reserve(const PairRoom& room);
};

/// Owns the working memory of all workers. A worker takes the memory of its own number. All other members are
/// for the stepping thread.
class JobWorkers {
 public:
  JobWorkers(const SceneSettings& settings, const ContactLimit& contacts, unsigned count)
      : settings_(settings), contacts_(contacts), workers_(count) {}

  [[nodiscard]] JobWorker& operator[](unsigned worker) { return workers_[worker]; }
  [[nodiscard]] std::span<JobWorker> all() { return workers_; }

  /// Begins a step: the counters are 0.
  void begin();
  /// Ends a worker's part of a round of jobs. The worker calls this itself. One that is alone counts once a
  /// step, in `equalize_capacity`.
  void end_round(unsigned worker) {
    if (workers_.size() > 1) workers_[worker].count_bytes();
  }
  /// The counters of all workers together.
  [[nodiscard]] PairCounters counters() const;

  /// Gives all workers the capacity that any of them needed, so that a step like the last one allocates
  /// nothing, whichever worker gets which job. It takes time only if the lists of a worker have grown since
  /// the last time. Returns false if the time budget ended before all was done.
  [[nodiscard]] bool equalize_capacity(const StepDeadline& deadline);
  /// Reserves memory for the contacts of a pair, of steps with so many contacts.
  void reserve(std::size_t contacts);
  /// Reserves memory for pairs with objects of that mesh, which may be solids.
  void reserve_for(const IndexedMesh& mesh, bool is_solid);
  /// The growth of the fronts in the pairs' memories.
  [[nodiscard]] std::size_t front_bytes() const;
  /// The bytes of all workers, each as of the end of its last round.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void make_room();
  void note_equal();

  const SceneSettings& settings_;
  const ContactLimit& contacts_;
  std::vector<JobWorker> workers_;
  PairRoom room_;               ///< the capacity that was reserved for each worker
  bool is_for_solids_ = false;  ///< whether it was reserved for pairs with solids, too
};

}  // namespace graze
