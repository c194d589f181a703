#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <graze/report.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/task_pool.hpp"
#include "core/surface/surface.hpp"
#include "objects/object.hpp"
#include "objects/object_bytes.hpp"
#include "objects/swept_objects.hpp"

namespace graze {

/// Surfaces with more vertices than this are read and refitted in parts, each of which takes some tens of
/// microseconds.
constexpr std::uint32_t vertices_of_part = 8192;

/// Sees bound memory that a step has read, surveyed or viewed, where it may be new.
class MemoryObserver {
 public:
  virtual ~MemoryObserver() = default;
  virtual void see_memory(const Object& object) noexcept = 0;
};

/// The step that reads belong to.
struct ReadsOfStep {
  std::uint64_t first_unseen = 0;      ///< the arrival of the first object that no step has seen
  std::size_t objects = 0;             ///< how many there are
  MemoryObserver* observer = nullptr;  ///< null where nobody looks
};

/// The objects that wait for a read, and the reads of a step. Small objects are planned and read by the same
/// task, one after the other, since a second pass would find them out of the caches. Large objects are
/// planned first, and read in parts. Stepping thread only.
class PositionReads {
 public:
  /// For `with_blocks`, see ObjectStore. `swept` and `bytes` stay.
  PositionReads(bool with_blocks, const SweptObjects& swept, ObjectBytes& bytes)
      : with_blocks_(with_blocks), swept_(swept), bytes_(bytes) {}

  /// Lists an object for the next read, where it is not listed. `is_read` says that no promise will keep it
  /// unread.
  void expect(Object& object, bool is_read = true);
  /// Makes room for one more object. Then `expect` and `sort_in` do not throw the next time.
  void make_room_for_one();
  /// Lists an object that has another mesh as what it is now, small or large.
  void sort_in(Object& object);
  /// Leaves out the objects that were removed.
  void drop_removed();
  /// Makes room for that many small objects.
  void reserve(std::size_t count);

  /// Appends what was found by reads of a step that came to no end.
  void report_problems(std::vector<Diagnostic>& diagnostics);
  /// Reads, surveys or leaves unread all objects that wait, as ObjectStore::read_positions says. `changed`
  /// holds afterwards if it `has_changed` before.
  void read(const ReadsOfStep& step, bool has_changed, TaskPool& tasks, std::vector<Diagnostic>& diagnostics);
  /// Reads the objects in `wanted`, which were left unread or surveyed in this step.
  void read_unread(std::span<Object* const> wanted, const ReadsOfStep& step, TaskPool& tasks,
                   std::vector<Diagnostic>& diagnostics);
  /// Reads objects that came into a step after `read`, or moved then.
  void read_ghosts(std::span<Object* const> ghosts, const ReadsOfStep& step, TaskPool& tasks,
                   std::vector<Diagnostic>& diagnostics);
  /// Forgets which objects are listed twice or not at all, after a step that failed. No object counts as
  /// listed when it is called.
  void list_anew() noexcept;

  /// Whether a read found an object elsewhere, frozen or live, or unread.
  [[nodiscard]] bool changed() const { return changed_; }
  [[nodiscard]] std::size_t unread_count() const { return unread_count_; }
  [[nodiscard]] std::size_t surveyed_count() const { return surveyed_count_; }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// A range of vertices of a large object.
  struct Part {
    Object* object;
    std::uint32_t begin;
    std::uint32_t count;
    Surface::PartSeen seen;
    bool keeps_start = false;  ///< of the object, for sweeps
  };
  struct LargeObject {
    Object* object;
    std::size_t end;  ///< the end of its parts in `parts_`
    bool keeps_start = false;
    bool accepted = true;
  };
  struct Problem {
    std::uint64_t serial;
    Diagnostic diagnostic;
  };
  /// Counts of a task that reads small objects.
  struct Counts {
    std::size_t unread = 0;
    std::size_t surveyed = 0;
    std::size_t vertices = 0;
    bool changed = false;
  };

  [[nodiscard]] bool is_new(const Object& object) const { return object.arrival >= step_.first_unseen; }
  void begin(const ReadsOfStep& step);
  void drop_those_without_input();
  void make_room_for_late();
  void note_which_are_read();
  void plan_large();
  bool plan(Object& object, Counts& counts) const;
  static void leave_unread(Object& object, Counts& counts);
  void plan_late(Object& object);
  void list_planned(Object& object);
  void list_in_parts(Object& object);
  void add(const Counts& counts);
  void read_all(std::span<Object*> small, double nanoseconds, TaskPool& tasks);
  static void read_part(Part& part);
  void read_planned(std::size_t begin, std::size_t end);
  void read_small(std::span<Object*> small, std::size_t begin, std::size_t end);
  void read_one(Object& object, std::optional<Problem>& problem, Counts& counts);
  void show_memory(Object& object) const;
  void show_what_was_read() const;
  void finish_large(TaskPool& tasks);
  void finish_parts(std::size_t index, std::size_t& to_write);

  bool with_blocks_;
  const SweptObjects& swept_;
  ObjectBytes& bytes_;
  ReadsOfStep step_;

  // Objects that may have input, in any order:
  std::vector<Object*> small_;  ///< a read leaves null in the place of one that has none
  std::vector<Object*> large_;
  std::size_t vertices_expected_ = 0;  ///< of the small ones: of the last read, and of those listed since

  // Listed by each read:
  std::vector<Object*> planned_;        ///< objects that are planned and read as one
  std::vector<LargeObject> in_parts_;   ///< large ones
  std::vector<Part> parts_;             ///< of all of these
  std::size_t vertices_to_read_ = 0;    ///< of planned objects
  std::vector<std::uint8_t> was_read_;  ///< of each of `small_`, where there is an observer
  /// One for each of `planned_`, then of `in_parts_`, and then of `small_`. All are empty once reported.
  std::vector<std::optional<Problem>> found_;
  std::vector<Problem> problems_;  ///< by serial, empty once reported
  // What tasks add to:
  std::atomic<std::size_t> unread_count_ = 0;
  std::atomic<std::size_t> surveyed_count_ = 0;
  std::atomic<std::size_t> vertices_read_ = 0;
  std::atomic<bool> some_problems_ = false;  ///< some problems are not reported yet
  std::atomic<bool> some_dropped_ = false;   ///< there are nulls in `small_`
  std::atomic<bool> changed_ = false;
};

}  // namespace graze
