#pragma once

#include <cstdint>
#include <graze/settings.hpp>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "objects/object_bytes.hpp"
#include "pairs/pair_job.hpp"

namespace graze {

/// Refits the bounds of regions that a step's jobs need. Stepping thread only.
class RegionRefit {
 public:
  RegionRefit(const SceneSettings& settings, TaskPool& tasks, ObjectBytes& bytes);

  /// Refits every object that `jobs` test and that has moved too far since its last refit.
  void run(std::span<const PairJob> jobs);

  /// Reserves memory for that many jobs.
  void reserve(std::size_t jobs);
  /// Makes the bounds of a surface ahead of its first job.
  void prepare(Surface& surface) const;
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// A range of an object's regions that one task refits.
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
  ObjectBytes& bytes_;
  RefitOf boxes_;
  bool with_blocks_;              ///< jobs search in blocks of vertices
  bool needs_paper_bounds_;       ///< the paper's bounds are reported or compared
  std::uint64_t refits_ = 0;      ///< the number of refits so far, which identifies the current one
  std::vector<Object*> objects_;  ///< the objects of the jobs, each once
  std::vector<Object*> small_;
  std::vector<Object*> large_;  ///< large objects that are refitted
  std::vector<Part> parts_;     ///< the parts of the objects in `large_`
};

}  // namespace graze
