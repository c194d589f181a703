#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/leaf_front.hpp>
#include <graze/region_tree.hpp>
#include <graze/surface.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace graze {

/// What is asked of one pair of objects.
struct PairQuery {
  ContactDetail detail = ContactDetail::features;
  AccuracyMode mode = AccuracyMode::exact;
  double threshold = 0;  ///< strictly closer is a contact; margins included
  double reach = 0;      ///< at least `threshold`; pairs strictly closer are listed
  double tolerance = 0;  ///< of AccuracyMode::within
  /// How far the surfaces may move until a front found now is of no more use; 0: none is kept.
  double slack = 0;
  /// Where the closest points are looked for, leaves are looked into for what is this much further than need
  /// be, so that it is known for some steps which of them have nothing as near as that.
  double look_slack = 0;
  /// Where all contacts are looked for, features that are this much further than the threshold are listed, so
  /// that for some steps no others need be asked; 0: none are.
  double list_slack = 0;
  /// A front of more pairs of leaves than this is not kept, nor a list of more pairs of features.
  std::size_t front_limit = std::numeric_limits<std::size_t>::max();
  /// The most contacts that an answer keeps: the nearest, and of those that are as near the lowest names. 0:
  /// all. Where more are found, no features are listed for the next steps.
  std::size_t contact_limit = 0;
  /// How many distances of regions are listed at most; 0: none are looked for.
  std::size_t region_distance_limit = 0;
  /// Regions are listed that may be nearer than this; in AccuracyMode::paper, those that pass its test.
  double region_distance_reach = 0;
  std::span<const double>
      epsilon;  ///< AccuracyMode::paper's numbers, of which the last is DV's `threshold`; empty: eq. 3 and 6
  /// Region pairs that may be tested; beyond it the answer is not complete.
  std::uint64_t work_limit = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::chrono::steady_clock::time_point no_deadline =
      std::chrono::steady_clock::time_point::max();
  /// A search ends some tens of microseconds after its deadline; the answer is not complete then.
  std::chrono::steady_clock::time_point deadline = no_deadline;
  /// The search ends before its deadline by this for each contact found, so that the caller can take them.
  std::chrono::nanoseconds time_after_contact{0};
};

/// Work done for a pair, or for many.
struct GRAZE_API PairCounters {
  std::uint64_t region_pairs_tested = 0;
  std::uint64_t leaf_pairs_tested = 0;
  std::uint64_t discarded_in_float = 0;  ///< pairs of features or vertices, of two leaves
  std::uint64_t named_in_float = 0;      ///< contacts, as often as they were found
  std::uint64_t decided_in_double = 0;   ///< questions
  std::uint64_t exact_decisions = 0;     ///< questions that double could not decide
  std::uint64_t fronts_left_out = 0;     ///< fronts that were not kept because of PairQuery::front_limit
  std::uint64_t pairs_by_list = 0;       ///< pairs of objects of which a list of features was asked alone
  /// Pairs of regions expanded, by level.
  std::array<std::uint64_t, RegionTree::max_level + 1> regions_expanded{};

  void add(const PairCounters& other);
};

/// How large the pairs are that working memory makes room for ahead of time. Pairs that need more take it
/// when they are met.
struct GRAZE_API PairRoom {
  // Of one pair:
  std::size_t contacts = 0;
  std::size_t leaf_pairs = 0;        ///< that may be near
  std::size_t ties = 0;              ///< names at the least distance, and features about them
  std::size_t region_distances = 0;  ///< listed
  // Of the largest of the meshes:
  std::size_t vertices = 0;
  std::size_t regions = 0;
  std::size_t leaf_vertices = 0;
  std::size_t leaf_edges = 0;
  std::size_t leaf_faces = 0;

  /// Takes up how large a mesh's regions are.
  void include(const Mesh& mesh);
};

/// What is known of one pair of objects, but for its lists.
struct PairFinding {
  bool in_contact = false;
  bool listed = false;   ///< in contact, or nearer than the reach; otherwise nothing below means anything
  bool complete = true;  ///< false where the work limit was reached: the bounds hold, contacts are empty
  bool cut = false;      ///< there were more contacts than PairQuery::contact_limit; all else is said of all
  std::uint32_t contacts_left_out = 0;  ///< for whoever keeps less of them than were found
  DistanceBounds distance;
  Witness witness;
  std::uint64_t region_distances_left_out = 0;  ///< at least so many more were not listed
};

struct PairAnswer : PairFinding {
  std::vector<Contact> contacts;  ///< sorted by (kind, feature a, feature b)
  /// By level; those of `PairDetector::region_distances`.
  std::vector<RegionDistance> region_distances;
};

/// Answers queries about pairs of surfaces: DMV, DV and contact determination (paper, sections 3.2 and 3.3).
/// Keeps its working memory from query to query. One thread at a time; any number of detectors may share the
/// surfaces.
class GRAZE_API PairDetector {
 public:
  PairDetector();
  ~PairDetector();
  PairDetector(PairDetector&&) noexcept;
  PairDetector& operator=(PairDetector&&) noexcept;

  /// Both surfaces have been refitted, by `refit_vertices` for the details `regions` and `vertices`, by
  /// `refit_faces` for the others: now for AccuracyMode::paper, otherwise ever; bounds are the looser the
  /// further the surfaces have moved since. Where `wants_blocks` says so it is `make_blocks` instead, now, or
  /// `make_stretches`.
  /// `answer` is overwritten, its memory used again; the work is added to `counters`.
  ///
  /// `front` is the same pair's of an earlier query, or a new one, and is brought up to date. It saves work
  /// and changes nothing in the answer, but in AccuracyMode::within which of the allowed bounds are given.
  void detect(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front,
              PairAnswer& answer, PairCounters& counters);
  /// The same without a front.
  void detect(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer,
              PairCounters& counters);

  /// Lists the pair's distances of regions in `answer`, level by level, as PairQuery::region_distance_limit
  /// says; both surfaces have been refitted now.
  void region_distances(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer);

  /// Makes as much room as `other` and this have needed, so that either could have done the work of both
  /// without taking memory.
  void reserve_as(const PairDetector& other);
  /// Makes room ahead of time.
  void reserve(const PairRoom& room);
  /// Bytes of working memory held.
  [[nodiscard]] std::size_t byte_count() const;

  /// Bounds that need no search and no refit, for a pair whose turn does not come: an answer that is not
  /// complete.
  static void outer_bounds(const Surface& a, const Surface& b, const PairQuery& query, PairAnswer& answer);

 private:
  friend class LargePair;
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

/// Whether `detail` is about vertices, so that distances are between vertices and not between surfaces.
constexpr bool is_about_vertices(ContactDetail detail) {
  return detail == ContactDetail::regions || detail == ContactDetail::vertices;
}
/// Whether a query asks for blocks of vertices.
constexpr bool wants_blocks(ContactDetail detail, AccuracyMode mode) {
  return detail == ContactDetail::vertices && mode != AccuracyMode::paper;
}
/// The boxes that a query of this detail asks for.
constexpr RefitOf boxes_for(ContactDetail detail) {
  return is_about_vertices(detail) ? RefitOf::vertices : RefitOf::faces;
}

}  // namespace graze
