#pragma once

#include <chrono>
#include <cstdint>
#include <graze/settings.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/contact_limit.hpp"
#include "base/shared_buffer.hpp"
#include "base/task_pool.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/sweep/pair_sweep.hpp"
#include "objects/object_bytes.hpp"
#include "objects/swept_objects.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// The result of the sweep of a job's pair. The impacts are in a shared buffer.
struct SweptJob : SweepFinding {
  std::uint32_t job = 0;
  bool met = false;  ///< so that the report lists the pair
  std::span<const Impact> impacts;
};

/// Sweeps the pairs of a step whose jobs ask for it, before the pairs are searched. A sweep needs nothing of
/// what a pair remembers, so it runs apart from the search. Stepping thread only.
///
/// A task writes the result of its own pair and the memory of its own worker. Lists of impacts go into a
/// shared buffer. Motions are only read once their boxes are made.
class PairSweeps {
 public:
  PairSweeps(const SceneSettings& settings, TaskPool& tasks, ObjectBytes& bytes)
      : settings_(settings), limit_(settings), tasks_(tasks), bytes_(bytes), impacts_(tasks.worker_count()) {}

  /// Sweeps all pairs that ask for it, and tells their jobs whether they met. The time budget began at
  /// `start`.
  void run(std::span<PairJob> jobs, const SweptObjects& objects, std::chrono::steady_clock::time_point start);
  /// The result for a job that asked for it. It is valid until `equalize_capacity`.
  [[nodiscard]] const SweptJob& of(std::size_t job) const;
  /// The pairs swept in the last `run`.
  [[nodiscard]] std::size_t count() const { return swept_.size(); }
  /// The work of the last `run`.
  [[nodiscard]] SweepWork work() const;

  /// Reserves memory for that many objects and pairs that are swept in a step, and for their impacts.
  void reserve(std::size_t objects, std::size_t pairs, std::size_t impacts);
  /// Reserves the workers' memory for surfaces of a mesh, if `reserve` was called.
  void reserve_for(const IndexedMesh& mesh);
  /// Gives all workers the capacity that any of them needed, and discards what was found.
  void equalize_capacity();
  /// The bytes held, but for those of the workers.
  [[nodiscard]] std::size_t byte_count() const;
  /// The bytes held by the workers.
  [[nodiscard]] std::size_t thread_byte_count() const;

 private:
  struct Worker {
    PairSweep sweep;
    SweepAnswer answer;
    SweepWork work;
  };

  void make_workers();
  void list(std::span<const PairJob> jobs);
  void make_boxes(const SweptObjects& objects);
  void sweep(std::size_t index, unsigned worker, std::uint64_t work_limit);
  [[nodiscard]] SweepQuery query() const;

  const SceneSettings& settings_;
  const ContactLimit limit_;
  TaskPool& tasks_;
  ObjectBytes& bytes_;
  std::chrono::steady_clock::time_point deadline_;
  std::span<const PairJob> jobs_;
  const SweptObjects* objects_ = nullptr;
  std::vector<SweptJob> swept_;      ///< ascending by job
  std::vector<Object*> on_the_way_;  ///< the objects of these, each once
  std::vector<Worker> workers_;      ///< empty until the first sweep, or until memory is reserved
  SharedBuffer<Impact> impacts_;
  std::optional<PairRoom> room_;  ///< that was reserved
};

}  // namespace graze
