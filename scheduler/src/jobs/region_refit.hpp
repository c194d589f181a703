#pragma once

#include <cstdint>
#include <graze/settings.hpp>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// Brings the bounds of regions up to date that a step's jobs ask for. Stepping thread only.
class RegionRefit {
 public:
  RegionRefit(const SceneSettings& settings, TaskPool& tasks);

  /// Refits every object that `jobs` look at and that has moved too far since its last refit.
  void run(std::span<const PairJob> jobs);

  /// Makes room for so many jobs.
  void reserve(std::size_t jobs);
  /// Makes a surface's bounds, so that its first job finds them.
  void prepare(Surface& surface) const;
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// Regions of one object, refitted by one task.
  struct Part {
    Object* object;
    std::uint32_t begin;
    std::uint32_t end;
  };

  void refit(std::span<const PairJob> jobs, RefitOf what);
  [[nodiscard]] bool with_radii() const { return needs_paper_bounds_ && boxes_ == RefitOf::vertices; }
  void list_objects(std::span<const PairJob> jobs, RefitOf what);
  void count_job(Object& object, const Object& other, const PairJob& job);
  [[nodiscard]] bool is_stale(const Object& object, RefitOf what) const;
  void list_parts(Object& object, RefitOf what);
  void refit_small(Object& object, RefitOf what) const;
  void make_blocks();
  [[nodiscard]] static bool is_seen_in_part(const Object& object);

  TaskPool& tasks_;
  RefitOf boxes_;
  bool with_blocks_;              ///< of vertices
  bool needs_paper_bounds_;       ///< bounds are told of or compared as they are in the paper
  std::uint64_t refits_ = 0;      ///< made so far, by which objects know the one under way
  std::vector<Object*> objects_;  ///< of the jobs, each once
  std::vector<Object*> small_;
  std::vector<Object*> large_;  ///< that are refitted
  std::vector<Part> parts_;     ///< of `large_`
};

}  // namespace graze
