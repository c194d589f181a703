#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/object_id.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graze {

/// Whether a pair is in contact, and was in the report before: `near` is not in contact, `began` is and was
/// not, `touching` is and was, `ended` is not and was. Every contact that began ends in one row: also where
/// an object is removed, or the pair is taken out by a filter.
enum class PairPhase : std::uint8_t { near, began, touching, ended };

/// One listed pair of objects; a was added before b.
struct PairReport {
  /// The objects. An id stays good as a key in the row in which the pair ended because its object was
  /// removed.
  ObjectId a;
  ObjectId b;
  std::uint64_t user_data_a = 0;  ///< ObjectSettings::user_data of a, also after a's removal
  std::uint64_t user_data_b = 0;  ///< and of b
  PairPhase phase = PairPhase::near;
  /// False: a budget ran out; bounds hold, the phase is the last one, no contacts. Or `contacts_cut`.
  bool complete = true;
  /// The positions or the pose of one of the objects were not taken: these are the last values.
  bool stale = false;
  /// There are more contacts than SceneSettings::max_contacts or max_contacts_per_pair let be listed: the
  /// nearest are. All else is said of all.
  bool contacts_cut = false;
  /// A pair that ended because an object was removed has the bounds and the witness of the report before.
  DistanceBounds distance;
  Witness witness;
  std::size_t first_contact = 0;  ///< into FrameReport::contacts()
  std::size_t contact_count = 0;
  std::size_t first_region_distance = 0;  ///< into FrameReport::region_distances()
  std::size_t region_distance_count = 0;
};

enum class DiagnosticKind : std::uint8_t {
  stale_id,           ///< the id names no object (any more)
  wrong_count,        ///< another number of positions than the mesh has vertices
  null_memory,        ///< no memory given
  misaligned_memory,  ///< memory or stride not aligned to its number type
  wrong_motion,       ///< positions for a rigid or fixed object, or a pose for a deformable one
  bad_pose,           ///< further than 1e-3 from a rotation, or not finite
  not_finite,         ///< NaN or infinity in a used vertex
  too_large,          ///< a coordinate of a used vertex beyond 2^120
  broken_promise,     ///< a vertex moved further than max_displacement
  bad_pair,           ///< a pair of an object with itself
  bad_rule,           ///< a kind above 255, or a threshold that is negative or NaN
  out_of_memory,      ///< there was no memory for a call
};

/// The enumerator's own name.
GRAZE_API std::string_view to_string(DiagnosticKind kind);
GRAZE_API std::string_view to_string(PairPhase phase);
GRAZE_API std::string_view to_string(ContactKind kind);
GRAZE_API std::string_view to_string(FeatureKind kind);
GRAZE_API std::string_view to_string(Side side);

/// Bad input to one object: what it was, and that the scene goes on.
struct Diagnostic {
  ObjectId object;
  DiagnosticKind kind = DiagnosticKind::stale_id;
  std::string message;
};

/// The most levels that the octree of a mesh can have, with level 0, the whole mesh.
inline constexpr std::size_t max_region_levels = 41;

/// Counters and times of one step.
struct StepStatistics {
  std::uint64_t objects = 0;
  std::uint64_t objects_unread = 0;    ///< not read, since promises say that they are far from everything
  std::uint64_t objects_surveyed = 0;  ///< looked at for their box first, in place of being copied
  std::uint64_t pairs_total = 0;       ///< n(n-1)/2
  /// Objects that moved, but inside their loose boxes (docs/embedding.md): no pair of them can have come.
  std::uint64_t objects_in_slack = 0;
  std::uint64_t boxes_tested = 0;     ///< boxes against a box, to find pairs of loose boxes that meet
  std::uint64_t pairs_close = 0;      ///< pairs whose loose boxes meet; those that follow are among them
  std::uint64_t pairs_filtered = 0;   ///< taken out by the filters: the sum of the next four
  std::uint64_t pairs_fixed = 0;      ///< both objects are fixed
  std::uint64_t pairs_by_layer = 0;   ///< otherwise: one's layer is not in the other's mask
  std::uint64_t pairs_in_group = 0;   ///< otherwise: both are in one group
  std::uint64_t pairs_ignored = 0;    ///< otherwise: ignored one by one
  std::uint64_t pairs_apart = 0;      ///< not filtered out, but the objects' boxes are not within reach
  std::uint64_t pairs_unchanged = 0;  ///< neither object has moved since the last answer, which is repeated
  std::uint64_t pairs_tested = 0;     ///< given to DMV, but for
  std::uint64_t pairs_by_list = 0;  ///< those of which the features near in an earlier step were asked alone
  std::uint64_t pairs_near = 0;     ///< listed in the report
  std::uint64_t pairs_in_contact = 0;
  std::uint64_t contacts = 0;
  std::uint64_t pairs_cut = 0;  ///< of which contacts had no place within SceneSettings' limits,
  /// and at least how many. What a pair's own limit leaves out is not looked for, and counts as one.
  std::uint64_t contacts_left_out = 0;
  std::uint64_t region_distances = 0;
  /// At least so many more had no place within SceneSettings::region_distances.
  std::uint64_t region_distances_left_out = 0;
  std::uint64_t region_pairs_tested = 0;
  std::uint64_t leaf_pairs_tested = 0;
  std::uint64_t discarded_in_float = 0;  ///< pairs of features or vertices that were certainly too far
  std::uint64_t named_in_float = 0;      ///< contacts that float was certain of, as often as they were found
  std::uint64_t decided_in_double = 0;   ///< questions that double answered
  std::uint64_t exact_decisions = 0;     ///< questions that double could not decide
  /// Pairs that will be searched from their roots in the next step: all pairs' fronts together are kept up to
  /// 2^22 pairs of leaves, and each pair's up to an equal share of it. It costs time and changes no answer.
  std::uint64_t fronts_left_out = 0;
  /// Region pairs expanded, by level.
  std::array<std::uint64_t, max_region_levels> regions_expanded{};
  // Memory that the scene holds from step to step, in bytes; meshes and what oneTBB holds are not counted.
  std::uint64_t object_bytes = 0;  ///< of objects: positions, copies of them, boxes, radii; waiting calls
  std::uint64_t pair_bytes = 0;    ///< of pairs: what is remembered, and answers
  std::uint64_t report_bytes = 0;  ///< of all reports, those held by handles and those to be filled again
  std::uint64_t thread_bytes = 0;  ///< working memory of the threads; which of them does what is chance
  double read_ms = 0;              ///< staged changes, positions, objects' boxes
  double pairs_ms = 0;             ///< broad phase and filters
  double refit_ms = 0;             ///< boxes and radii of the regions
  double jobs_ms = 0;              ///< DMV, DV and contacts
  double publish_ms = 0;           ///< the report
  double step_ms = 0;              ///< all of them
};

/// The published answer of one step; immutable. Read it from any thread.
class GRAZE_API FrameReport {
 public:
  FrameReport() = default;
  FrameReport(const FrameReport& other);
  FrameReport& operator=(const FrameReport& other);
  ~FrameReport() = default;

  /// 1 for the first step; 0 before it.
  [[nodiscard]] std::uint64_t frame() const { return frame_; }
  /// The number that the caller gave to `Scene::step` or `Scene::step_async`; 0 where none was given, and
  /// before the first step.
  [[nodiscard]] std::uint64_t tag() const { return tag_; }
  /// Sorted by the order in which a, then b, were added.
  [[nodiscard]] std::span<const PairReport> pairs() const { return shown_->pairs; }
  /// The contacts of all pairs, in the pairs' order; within a pair by (kind, feature a, feature b).
  [[nodiscard]] std::span<const Contact> contacts() const { return shown_->contacts; }
  /// The contacts of one pair of this report.
  [[nodiscard]] std::span<const Contact> contacts(const PairReport& pair) const {
    return contacts().subspan(pair.first_contact, pair.contact_count);
  }
  /// For how many steps before this one the features of one of its contacts have been so without a break.
  [[nodiscard]] std::uint64_t age(const Contact& contact) const { return frame_ - contact.since; }
  /// The distances of regions that are alive, of all pairs, where SceneSettings::region_distances asks for
  /// them: in the pairs' order, within a pair by level.
  [[nodiscard]] std::span<const RegionDistance> region_distances() const { return shown_->region_distances; }
  /// Those of one pair of this report.
  [[nodiscard]] std::span<const RegionDistance> region_distances(const PairReport& pair) const {
    return region_distances().subspan(pair.first_region_distance, pair.region_distance_count);
  }
  [[nodiscard]] std::span<const Diagnostic> diagnostics() const { return diagnostics_; }
  [[nodiscard]] const StepStatistics& statistics() const { return statistics_; }
  /// Whether no budget cut any pair short, and no limit its contacts.
  [[nodiscard]] bool complete() const { return complete_; }

 private:
  friend class ReportBuilder;
  struct Rows {
    std::vector<PairReport> pairs;
    std::vector<Contact> contacts;
    std::vector<RegionDistance> region_distances;
  };

  std::uint64_t frame_ = 0;
  std::uint64_t tag_ = 0;
  bool complete_ = true;
  Rows rows_;
  /// Its own rows, or those of an earlier report of the scene, which were these.
  const Rows* shown_ = &rows_;
  std::vector<Diagnostic> diagnostics_;
  StepStatistics statistics_;
};

class ReportPool;

/// Keeps one report alive, also after its scene. Copying, moving and destroying are wait-free. A handle
/// belongs to one thread at a time; handles of one report may live on any number of threads.
class GRAZE_API ReportHandle {
 public:
  ReportHandle() = default;
  ReportHandle(const ReportHandle& other);
  ReportHandle(ReportHandle&& other) noexcept
      : pool_(std::exchange(other.pool_, nullptr)),
        slot_(std::exchange(other.slot_, 0)),
        report_(std::exchange(other.report_, nullptr)) {}
  ReportHandle& operator=(ReportHandle other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(slot_, other.slot_);
    std::swap(report_, other.report_);
    return *this;
  }
  ~ReportHandle();

  [[nodiscard]] const FrameReport& operator*() const { return *report_; }
  [[nodiscard]] const FrameReport* operator->() const { return report_; }
  [[nodiscard]] const FrameReport* get() const { return report_; }
  [[nodiscard]] explicit operator bool() const { return report_ != nullptr; }

 private:
  friend class ReportPool;
  ReportHandle(ReportPool* pool, std::uint32_t slot, const FrameReport* report)
      : pool_(pool), slot_(slot), report_(report) {}

  ReportPool* pool_ = nullptr;
  std::uint32_t slot_ = 0;
  const FrameReport* report_ = nullptr;
};

}  // namespace graze
