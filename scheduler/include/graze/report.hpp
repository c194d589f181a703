#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/impact.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/patch.hpp>
#include <graze/position_view.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graze {

/// @addtogroup report
/// @{

/// Says whether a pair is in contact now, and whether it was in the report before. Every contact that began
/// ends in one row. That also holds when an object is removed, or when a filter takes the pair out.
enum class PairPhase : std::uint8_t {
  near,      ///< The pair is not in contact, and was not in the report before.
  began,     ///< The pair is in contact, and was not in the report before.
  touching,  ///< The pair is in contact, and was in the report before.
  ended,     ///< The pair is not in contact, and was in the report before.
};

/// One row of a report: a pair of objects that is near, in contact, or has just ended. Object a was added to
/// the scene before object b.
struct PairReport {
  /// The object of the pair that was added first. If a pair ends because its object was removed, the id stays
  /// valid as a key in that row.
  ObjectId a;
  /// The object of the pair that was added last. The id stays valid as a key in the row that reports a
  /// removal.
  ObjectId b;
  /// ObjectSettings::user_data of object a, even after that object was removed.
  std::uint64_t user_data_a = 0;
  /// ObjectSettings::user_data of object b, even after that object was removed.
  std::uint64_t user_data_b = 0;
  /// Whether the pair is in contact, and whether it was in the report before.
  PairPhase phase = PairPhase::near;
  /// False if a budget ran out before the pair was done, or if #contacts_cut is true. When a budget ran out,
  /// the bounds still hold, the phase is the last known one, and there are no contacts.
  bool complete = true;
  /// True if the positions or the pose of one of the objects were not taken. The row then repeats the last
  /// values of the pair.
  bool stale = false;
  /// True if SceneSettings::max_contacts or SceneSettings::max_contacts_per_pair left contacts out. The
  /// nearest ones are listed, or with ContactDetail::nearest the deepest. Phase, distance and witness are
  /// those of all contacts.
  bool contacts_cut = false;
  /// Whether one object is inside the other, if one of them is a solid (ObjectSettings::solid). It is
  /// Inside::none if #complete is false because a budget ran out, and in a row that says #phase `ended`.
  Inside inside = Inside::none;
  /// The bounds of the distance of the pair, in the caller's units. If the pair ended because an object was
  /// removed, they are those of the report before.
  DistanceBounds distance;
  /// The two points that are DistanceBounds::upper apart. If the pair ended because an object was removed,
  /// they are those of the report before.
  Witness witness;
  /// The index of the pair's first contact in FrameReport::contacts().
  std::size_t first_contact = 0;
  /// The number of contacts of the pair.
  std::size_t contact_count = 0;
  /// The index of the pair's first region distance in FrameReport::region_distances().
  std::size_t first_region_distance = 0;
  /// The number of region distances of the pair.
  std::size_t region_distance_count = 0;
  /// How b leaves a, if SceneSettings::ways_out asks for it and the surfaces pass through each other: if
  /// #inside is Inside::crossing, or an edge pierces a face, or surfaces that share planes have sunk into
  /// each other. Otherwise all of it is 0.
  WayOut way_out;
  /// The earliest Impact::lower of the pair, if it was swept (ObjectSettings::swept). No features of the pair
  /// meet earlier in the step. It is 1 if none meet, or if the pair was not swept. It is 0 if #complete is
  /// false because a budget ran out before the sweep was done.
  double time_of_impact = 1;
  /// A time before which no features of the pair are as near as SceneSettings::swept_gap, if the pair was
  /// swept. It is 1 if they never are, or if no gap is asked about. It is 0 where #time_of_impact is 0 for
  /// lack of a budget.
  double time_of_gap = 1;
  /// The index of the pair's first impact in FrameReport::impacts().
  std::size_t first_impact = 0;
  /// The number of impacts of the pair.
  std::size_t impact_count = 0;
};

/// The kinds of bad input that a step reports. docs/embedding.md says what graze does in each case.
enum class DiagnosticKind : std::uint8_t {
  stale_id,           ///< The id names no object of the scene, or no longer does.
  wrong_count,        ///< The number of positions differs from the number of vertices of the mesh.
  null_memory,        ///< The memory that was given is null.
  misaligned_memory,  ///< The memory or a stride is not aligned to its number type.
  wrong_motion,       ///< Positions were given for a rigid or fixed object, or a pose for a deformable one.
  /// The pose is further than 1e-3 from a rotation, mirrors, or is not finite. Or the last row of a 4 x 4
  /// matrix is further than 1e-6 from (0, 0, 0, 1).
  bad_pose,
  not_finite,      ///< A vertex that a face uses has a coordinate that is NaN or infinite.
  too_large,       ///< A vertex that a face uses has a coordinate beyond 2^120.
  broken_promise,  ///< A vertex moved further than `max_displacement` promised.
  bad_pair,        ///< The pair is of an object with itself.
  bad_rule,        ///< A kind is above 255, or a threshold is negative or NaN.
  out_of_memory,   ///< There was no memory for a call.
};

/// Says what was wrong with the input about one object. The scene goes on.
struct Diagnostic {
  /// The object, by the id that the call named. It is a default id if the diagnostic names no object.
  ObjectId object;
  /// The kind of bad input.
  DiagnosticKind kind = DiagnosticKind::stale_id;
  /// One sentence for people that says what was wrong and where.
  std::string message;
};

/// The most levels that the octree of a mesh can have, with level 0, the whole mesh.
inline constexpr std::size_t max_region_levels = 41;

/// Counts what the searches of one step tested and decided.
struct StepWork {
  /// Boxes that the broad phase compared with another box.
  std::uint64_t boxes_tested = 0;
  /// Pairs of regions whose bounds were tested. In detail ContactDetail::vertices these are blocks of
  /// vertices.
  std::uint64_t region_pairs_tested = 0;
  /// Pairs of leaf regions whose features or vertices were tested.
  std::uint64_t leaf_pairs_tested = 0;
  /// Pairs of features or vertices that float arithmetic showed to be too far apart.
  std::uint64_t discarded_in_float = 0;
  /// Contacts whose features float arithmetic determined with certainty. A contact that is found more than
  /// once counts each time.
  std::uint64_t named_in_float = 0;
  /// Questions that double arithmetic answered with certainty.
  std::uint64_t decided_in_double = 0;
  /// Questions that double arithmetic left open, and that exact arithmetic answered.
  std::uint64_t exact_decisions = 0;
  /// Pairs that the next step searches from their root regions, because their front was too large to keep.
  /// All fronts together keep up to 2^22 pairs of leaves, and each pair of objects up to an equal share. It
  /// costs time and changes no answer.
  std::uint64_t fronts_left_out = 0;
  /// Pairs of regions that were expanded, by level. The root is level 0, and there are at most 40 levels
  /// below.
  std::array<std::uint64_t, max_region_levels> regions_expanded{};
  /// Pairs of regions that sweeps tested, by their boxes on the way.
  std::uint64_t swept_region_pairs = 0;
  /// Pairs of features whose boxes meet on the way, so that a sweep tested the features themselves.
  std::uint64_t swept_feature_pairs = 0;
  /// Pairs of features among #swept_feature_pairs that double arithmetic left open, and that exact arithmetic
  /// decided.
  std::uint64_t swept_exact_decisions = 0;
};

/// Counts the bytes that a scene holds. Meshes are not counted, see Mesh::byte_count(). Memory that oneTBB
/// holds is not counted either.
struct StepBytes {
  /// Bytes held for objects from step to step: positions, copies of them, bounds, and calls that wait.
  std::uint64_t objects = 0;
  /// Bytes held for pairs from step to step: answers, and what speeds up the next search.
  std::uint64_t pairs = 0;
  /// Bytes of all reports: those that handles keep, and those that the scene keeps to fill again.
  std::uint64_t reports = 0;
  /// Bytes of the working memory of the threads. They differ from run to run, because chance decides which
  /// thread does which work.
  std::uint64_t threads = 0;

  /// Returns the sum of all.
  [[nodiscard]] constexpr std::uint64_t total() const { return objects + pairs + reports + threads; }
};

/// The times of the stages of one step, in milliseconds.
struct StepTimes {
  /// Time to take up calls, read positions, and compute the bounding boxes of objects.
  double read_ms = 0;
  /// Time of the broad phase and the filters.
  double pairs_ms = 0;
  /// Time to refit the boxes and radii of regions.
  double refit_ms = 0;
  /// Time to search pairs for distances and contacts.
  double jobs_ms = 0;
  /// Time to put the report together.
  double publish_ms = 0;
  /// Time of the whole step.
  double step_ms = 0;
};

/// Counts the objects, pairs and contacts of one step, its work, and the memory that the scene holds, and
/// says how long the step took. Every step fills it.
struct StepStatistics {
  /// Objects in the scene.
  std::uint64_t objects = 0;
  /// Objects whose positions were not read, because promises of `max_displacement` show that they are far
  /// from everything.
  std::uint64_t objects_unread = 0;
  /// Objects that were surveyed: the step computed their bounding box without a copy of their positions.
  /// Those that came near another object, so that they were read as well, are included.
  std::uint64_t objects_surveyed = 0;
  /// All pairs of objects: n(n-1)/2 for n objects, and one more for each that is tested against itself.
  std::uint64_t pairs_total = 0;
  /// Objects that moved but stayed inside their loose boxes, so that the broad phase looked for no new pairs
  /// of them. A loose box is the object's box with room to move.
  std::uint64_t objects_in_slack = 0;
  /// Pairs that no filter takes out, and whose loose boxes meet. The counters #pairs_apart to #pairs_tested
  /// divide these pairs, but none has the pairs of an object that is frozen because its input was bad.
  std::uint64_t pairs_close = 0;
  /// Pairs of all objects, near or not, that a filter takes out: the sum of the next four counters.
  std::uint64_t pairs_filtered = 0;
  /// Pairs of two fixed objects.
  std::uint64_t pairs_fixed = 0;
  /// Pairs that are not counted in #pairs_fixed, and where the layer of one object is not in the mask of the
  /// other.
  std::uint64_t pairs_by_layer = 0;
  /// Pairs that no counter above has, and whose objects are in one group.
  std::uint64_t pairs_in_group = 0;
  /// Pairs that no counter above has, and that Scene::ignore() took out.
  std::uint64_t pairs_ignored = 0;
  /// Pairs that passed the filters, but whose bounding boxes are further apart than the pair's reach.
  std::uint64_t pairs_apart = 0;
  /// Pairs that repeat their last answer, because neither object has moved since.
  std::uint64_t pairs_unchanged = 0;
  /// Pairs that the step searched.
  std::uint64_t pairs_tested = 0;
  /// Pairs among #pairs_tested for which the step asked only the features that an earlier step found near.
  std::uint64_t pairs_by_list = 0;
  /// Rows in the report.
  std::uint64_t pairs_near = 0;
  /// Rows of pairs that are in contact.
  std::uint64_t pairs_in_contact = 0;
  /// Contacts in the report.
  std::uint64_t contacts = 0;
  /// Rows with PairReport::contacts_cut.
  std::uint64_t pairs_cut = 0;
  /// The report left out at least this many contacts, because of the limits in SceneSettings. A pair that
  /// only its own limit cuts counts as one, because graze does not look for its further contacts.
  std::uint64_t contacts_left_out = 0;
  /// Region distances in the report.
  std::uint64_t region_distances = 0;
  /// The report left out at least this many region distances, because of SceneSettings::region_distances.
  std::uint64_t region_distances_left_out = 0;
  /// Pairs that the step swept: one object is ObjectSettings::swept, one has moved, and their boxes met on
  /// the way.
  std::uint64_t pairs_swept = 0;
  /// Impacts in the report.
  std::uint64_t impacts = 0;
  /// What the searches tested and decided.
  StepWork work;
  /// The memory that the scene holds.
  StepBytes bytes;
  /// How long the stages took.
  StepTimes times;
};

/// @cond internal
class KeptByReports;
class KeptGeometry;
class KeptMeshes;
class KeptPatches;

/// Shares something that reports keep, or nothing. Copies may be made and destroyed by any thread.
class GRAZE_API KeptByReportsHandle {
 public:
  KeptByReportsHandle() = default;
  explicit KeptByReportsHandle(const KeptByReports* kept) noexcept;
  KeptByReportsHandle(const KeptByReportsHandle& other) noexcept : KeptByReportsHandle(other.kept_) {}
  KeptByReportsHandle& operator=(KeptByReportsHandle other) noexcept {
    std::swap(kept_, other.kept_);
    return *this;
  }
  ~KeptByReportsHandle();

 protected:
  const KeptByReports* kept_ = nullptr;
};

/// A handle that knows what it shares.
template <typename Kept>
class KeptHandle : public KeptByReportsHandle {
 public:
  using KeptByReportsHandle::KeptByReportsHandle;
  [[nodiscard]] const Kept* get() const { return static_cast<const Kept*>(kept_); }
};
/// @endcond

/// The published answer of one step. It never changes, so any number of threads may read it at the same time.
/// Programs get one through a ReportHandle.
class GRAZE_API FrameReport {
 public:
  /// Makes an empty report of frame 0.
  FrameReport() = default;
  /// Copies everything. The copy depends on no scene and no handle. Throws `std::bad_alloc`.
  FrameReport(const FrameReport& other);
  /// Replaces this report with a copy of `other`. Throws `std::bad_alloc`.
  FrameReport& operator=(const FrameReport& other);
  /// Frees the report.
  ~FrameReport() = default;

  /// Returns the number of the step. The first step is 1, and the report before it is 0.
  [[nodiscard]] std::uint64_t frame() const { return frame_; }
  /// Returns the number that the caller gave to Scene::step() or Scene::step_async(). It is 0 if none was
  /// given, and before the first step.
  [[nodiscard]] std::uint64_t tag() const { return tag_; }
  /// Returns one row for each listed pair. Rows are sorted by the order in which a, then b, were added.
  ///
  /// A pair is listed if its distance is below the larger of its range and its threshold, or if an edge
  /// pierces a face. It is listed once more when it has just ended, even beyond the range. A swept pair that
  /// met on the way is listed, too. Its phase says whether it is in contact now, at the end of the step.
  [[nodiscard]] std::span<const PairReport> pairs() const { return shown_->pairs; }
  /// Returns the contacts of all pairs in one array, in the order of the rows. The contacts of a pair are
  /// sorted by kind, feature a, feature b.
  [[nodiscard]] std::span<const Contact> contacts() const { return shown_->contacts; }
  /// Returns the contacts of one row of this report.
  [[nodiscard]] std::span<const Contact> contacts(const PairReport& pair) const {
    return contacts().subspan(pair.first_contact, pair.contact_count);
  }
  /// Returns for how many steps before this one the features of a contact have been in contact without a
  /// break. `contact` is one of this report.
  [[nodiscard]] std::uint64_t age(const Contact& contact) const { return frame_ - contact.since; }
  /// Returns the region distances of all pairs in one array, in the order of the rows. Those of a pair are
  /// sorted by level. The array is empty unless SceneSettings::region_distances asks for it.
  [[nodiscard]] std::span<const RegionDistance> region_distances() const { return shown_->region_distances; }
  /// Returns the region distances of one row of this report.
  [[nodiscard]] std::span<const RegionDistance> region_distances(const PairReport& pair) const {
    return region_distances().subspan(pair.first_region_distance, pair.region_distance_count);
  }
  /// Returns what meets between the last step and this one, of all pairs in one array, in the order of the
  /// rows. Those of a pair are sorted by Impact::lower, kind, feature a, feature b. The array is empty unless
  /// an object is ObjectSettings::swept.
  [[nodiscard]] std::span<const Impact> impacts() const { return shown_->impacts; }
  /// Returns the impacts of one row of this report.
  [[nodiscard]] std::span<const Impact> impacts(const PairReport& pair) const {
    return impacts().subspan(pair.first_impact, pair.impact_count);
  }
  /// Returns what was wrong with the input of this step. It is empty if all input was good.
  [[nodiscard]] std::span<const Diagnostic> diagnostics() const { return diagnostics_; }
  /// Returns the counters and times of this step.
  [[nodiscard]] const StepStatistics& statistics() const { return statistics_; }
  /// Returns true if no budget cut a pair short, and no limit left contacts out.
  [[nodiscard]] bool complete() const { return complete_; }
  /// Returns the mesh of an object as this step saw it, also after Scene::replace_mesh() or after the object
  /// was removed. It is null if the object was not in the scene.
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(ObjectId object) const;
  /// Returns the positions of an object that this report is about, in the precision in which they were given.
  /// The view is empty unless the object has ObjectSettings::queries and was in the scene. It is good for as
  /// long as this report, or a copy of it. Positions of vertices that no face uses mean nothing.
  [[nodiscard]] PositionView positions(ObjectId object) const;
  /// Returns what lay around an object in this step, for answers between steps. It is empty unless the object
  /// has ObjectSettings::patch_radius and was in the scene. It is good for as long as this report, or a copy
  /// of it.
  [[nodiscard]] Patch patch(ObjectId tool) const;

 private:
  friend class SceneQuery;
  friend class ReportBuilder;
  struct Rows {
    std::vector<PairReport> pairs;
    std::vector<Contact> contacts;
    std::vector<RegionDistance> region_distances;
    std::vector<Impact> impacts;
  };

  std::uint64_t frame_ = 0;
  std::uint64_t tag_ = 0;
  bool complete_ = true;
  Rows rows_;
  /// Either `rows_`, or the rows of an earlier report of the scene that are equal to what this report says.
  const Rows* shown_ = &rows_;
  std::vector<Diagnostic> diagnostics_;
  StepStatistics statistics_;
  KeptHandle<KeptGeometry> geometry_;
  KeptHandle<KeptMeshes> meshes_;
  KeptHandle<KeptPatches> patches_;
};

/// @cond internal
class ReportPool;
/// @endcond

/// Keeps one report alive, even after its scene is gone. A handle is used like a pointer to the report.
///
/// Copying, moving and destroying a handle is wait-free. One thread at a time may use a handle. Any number of
/// threads may hold handles of one report. A handle keeps the memory of its report, so let go of it soon.
class GRAZE_API ReportHandle {
 public:
  /// Makes an empty handle. It points at no report and must not be dereferenced.
  ReportHandle() = default;
  /// Makes a second handle of the same report.
  ReportHandle(const ReportHandle& other);
  /// Takes the report of `other`, which is empty afterwards.
  ReportHandle(ReportHandle&& other) noexcept
      : pool_(std::exchange(other.pool_, nullptr)),
        slot_(std::exchange(other.slot_, 0)),
        report_(std::exchange(other.report_, nullptr)) {}
  /// Lets go of the report of this handle, and keeps that of `other`.
  ReportHandle& operator=(ReportHandle other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(slot_, other.slot_);
    std::swap(report_, other.report_);
    return *this;
  }
  /// Lets go of the report. The scene fills its memory again when no handle is left.
  ~ReportHandle();

  /// Returns the report. The handle must not be empty.
  [[nodiscard]] const FrameReport& operator*() const { return *report_; }
  /// Gives access to the members of the report. The handle must not be empty.
  [[nodiscard]] const FrameReport* operator->() const { return report_; }
  /// Returns the report, or null if the handle is empty.
  [[nodiscard]] const FrameReport* get() const { return report_; }
  /// Returns true if the handle points at a report.
  [[nodiscard]] explicit operator bool() const { return report_ != nullptr; }

 private:
  friend class ReportPool;
  ReportHandle(ReportPool* pool, std::uint32_t slot, const FrameReport* report)
      : pool_(pool), slot_(slot), report_(report) {}

  ReportPool* pool_ = nullptr;
  std::uint32_t slot_ = 0;
  const FrameReport* report_ = nullptr;
};

/// @}

}  // namespace graze
