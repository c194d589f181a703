#pragma once

#include <cstdint>
#include <graze/contact.hpp>
#include <vector>

namespace graze {

/// The result for one pair of objects, without its lists.
struct PairFinding {
  bool in_contact = false;
  bool listed = false;   ///< in contact, or nearer than the reach. Otherwise nothing below means anything
  bool complete = true;  ///< false where the work limit was reached: the bounds hold, contacts are empty
  bool cut = false;      ///< there were more contacts than PairQuery::contact_limit. All else is said of all
  std::uint32_t contacts_left_out = 0;  ///< for whoever keeps less of them than were found
  Inside inside = Inside::none;
  WayOut way_out;  ///< where PairQuery::wants_way_out asked for it
  DistanceBounds distance;
  Witness witness;
  std::uint64_t region_distances_left_out = 0;  ///< at least so many more were not listed
};

struct PairAnswer : PairFinding {
  std::vector<Contact> contacts;  ///< sorted by (kind, feature a, feature b)
  /// By level, as `PairDetector::region_distances`.
  std::vector<RegionDistance> region_distances;
};

}  // namespace graze
