#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "leaves/feature_pairs.hpp"
#include "leaves/nearest_features.hpp"
#include "pair/near_listing.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "vertices/near_vertices.hpp"

// The finders of a search for contacts: which keys a detail has of the candidates that a source gives. A
// slice makes one of its own. What it can be given says which sources go with it (see contact_sources.hpp).
// Every finder says these:
//
//   finds_piercings   whether edges that pierce faces are contacts, at every threshold.
//   keeps_closest     whether a limit keeps the closest contacts.
//   leaves_choice     whether only all slices together tell which keys are contacts.
//   set_threshold     says that only keys nearer than a threshold are of interest from here on.
//   finish            ends the slice.
//
// A finder that takes listed pairs learns a new threshold after each `listed_at_once` of them, if a limit
// keeps the closest contacts.

namespace graze {

/// The input of a finder: the tools of a slice, and the places for what is found.
struct FinderInput {
  SearchWorker& worker;
  double threshold;
  FoundContacts& found;
  bool is_only_slice;
  // Observers, which may be nowhere:
  NearListing listing;
  TouchingEdges* touching;
  // For vertices:
  NearBlocks& blocks;
};

/// Finds the keys of `ContactDetail::regions`: of each two leaves the closest vertices.
class RegionFinder {
 public:
  static constexpr bool finds_piercings = false;
  static constexpr bool keeps_closest = true;
  static constexpr bool leaves_choice = false;

  explicit RegionFinder(const FinderInput& input) : input_(input) {}
  void add(const LeafOf& a, const LeafOf& b);
  static void set_threshold(double /*threshold*/) {}
  static void finish() {}

 private:
  const FinderInput& input_;
};

/// Finds the keys of `ContactDetail::vertices`: all pairs of vertices below the threshold.
class VertexFinder {
 public:
  static constexpr bool finds_piercings = false;
  static constexpr bool keeps_closest = true;
  static constexpr bool leaves_choice = false;
  /// Two vertices are compared as soon as they are left out.
  static constexpr std::size_t listed_at_once = std::numeric_limits<std::size_t>::max();

  explicit VertexFinder(const FinderInput& input);
  void add_listed(std::span<const FeaturePair> listed);
  bool add_blocks(std::size_t begin, std::size_t end);
  void set_threshold(double threshold) { threshold_ = threshold; }
  static void finish() {}

 private:
  const FinderInput& input_;
  double threshold_;
};

/// Finds the keys of `ContactDetail::features`.
class FeatureFinder : public CloseFeatures {
 public:
  static constexpr bool finds_piercings = true;
  static constexpr bool keeps_closest = true;
  static constexpr bool leaves_choice = false;
  static constexpr std::size_t listed_at_once = 1024;

  explicit FeatureFinder(const FinderInput& input);
};

/// Finds the keys of `ContactDetail::nearest`. If there are other slices, what is nearest to each vertex is
/// left in FoundContacts, in the order of vertices.
class NearestFinder : public NearestFeatures {
 public:
  static constexpr bool finds_piercings = true;
  static constexpr bool keeps_closest = false;  // but the deepest, once all have been measured
  static constexpr bool leaves_choice = true;

  explicit NearestFinder(const FinderInput& input);
  void finish();

 private:
  const FinderInput& input_;
};

}  // namespace graze
