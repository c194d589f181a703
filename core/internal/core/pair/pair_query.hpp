#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <limits>
#include <span>

#include "core/surface/surface.hpp"

namespace graze {

class FeatureFilter;

/// The question about one pair of objects.
struct PairQuery {
  ContactDetail detail = ContactDetail::features;
  AccuracyMode mode = AccuracyMode::exact;
  double threshold = 0;  ///< strictly closer is a contact, margins included
  double reach = 0;      ///< at least `threshold`. Pairs strictly closer are listed
  double tolerance = 0;  ///< of AccuracyMode::within
  /// How far the surfaces may move until a front found now is of no more use. With 0 none is kept.
  double slack = 0;
  /// The extra distance within which a search for the closest points tests leaves. It gives lower bounds that
  /// tell for some steps which leaves have nothing near enough.
  double leaf_test_slack = 0;
  /// The extra distance above the threshold within which a search for all contacts lists features. For some
  /// steps no other features need be tested. 0: none are listed.
  double list_slack = 0;
  /// A front of more pairs of leaves than this is not kept, nor a list of more pairs of features.
  std::size_t front_limit = std::numeric_limits<std::size_t>::max();
  /// The most contacts that an answer keeps: those of the lowest contact_rank(), and of equal ones those with
  /// the lowest keys. 0: all. Where more are found, no features are listed for the next steps, but with
  /// ContactDetail::nearest.
  std::size_t contact_limit = 0;
  /// Whether the surfaces are solids, so that it matters what is inside of them. This does not go with
  /// details about vertices, nor with AccuracyMode::paper.
  bool a_is_solid = false;
  bool b_is_solid = false;
  [[nodiscard]] bool has_solid() const { return a_is_solid || b_is_solid; }
  /// Whether the answer says how surfaces that pass through each other leave each other. This does not go
  /// with details about vertices, nor with AccuracyMode::paper.
  bool wants_way_out = false;
  /// How many distances of regions are listed at most. With 0 there are none.
  std::size_t region_distance_limit = 0;
  /// Regions are listed that may be closer than this. In AccuracyMode::paper these are those that pass its
  /// test.
  double region_distance_reach = 0;
  std::span<const double> epsilon;  ///< AccuracyMode::paper's numbers, of which the last is DV's `threshold`.
                                    ///< Empty means eq. 3 and 6
  /// Says which features are tested. It is null where all are. It leaves some. Fronts that are used were
  /// made with the same groups, ignored in the same way.
  const FeatureFilter* groups = nullptr;
  /// Region pairs that may be tested. Beyond it the answer is not complete.
  std::uint64_t work_limit = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::chrono::steady_clock::time_point no_deadline =
      std::chrono::steady_clock::time_point::max();
  /// A search ends some tens of microseconds after its deadline. The answer is not complete then.
  std::chrono::steady_clock::time_point deadline = no_deadline;
  /// The search ends before its deadline by this for each contact found, so that the caller can take them.
  std::chrono::nanoseconds time_after_contact{0};
};

/// The threshold of DV, without margins: the last of the paper's epsilons if there are any, and otherwise the
/// contact distance.
inline double threshold_of(double contact_distance, std::span<const double> epsilon) {
  return epsilon.empty() ? contact_distance : epsilon.back();
}

/// Whether `detail` is about vertices, so that distances are between vertices and not between surfaces.
constexpr bool is_about_vertices(ContactDetail detail) {
  return detail == ContactDetail::regions || detail == ContactDetail::vertices;
}
/// Whether edges that pierce faces are contacts of `detail`, at every threshold.
constexpr bool lists_piercings(ContactDetail detail) {
  return detail == ContactDetail::features || detail == ContactDetail::nearest;
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
