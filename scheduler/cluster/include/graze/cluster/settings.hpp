#pragma once

#include <cstdint>
#include <optional>

namespace graze::cluster {

/// @addtogroup cluster
/// @{

/// The settings of a cluster, which all ranks have alike.
struct ClusterSettings {
  /// Objects move to other ranks when the load of the busiest rank is more than this many times the mean. It
  /// is above 1. No value means that an object stays at the rank that has added it.
  ///
  /// The load is estimated from the vertices and contacts of each object, so it is the same in every run.
  std::optional<double> max_imbalance = std::nullopt;
};

/// The cost of one step at one rank: what it has sent to others, and how long it has waited.
struct ClusterStatistics {
  std::uint64_t objects = 0;          ///< that this rank has owned in this step
  std::uint64_t ghosts = 0;           ///< copies of objects of other ranks
  std::uint64_t arrivals = 0;         ///< objects that came from other ranks after this step
  std::uint64_t departures = 0;       ///< objects that went to other ranks after this step
  std::uint64_t neighbours = 0;       ///< ranks with which it has exchanged messages
  std::uint64_t messages = 0;         ///< that it has sent
  std::uint64_t bytes_boxes = 0;      ///< sent: boxes of objects, and what ranks agree on
  std::uint64_t bytes_positions = 0;  ///< sent: positions and poses of objects that moved near other ranks
  std::uint64_t bytes_meshes = 0;     ///< sent: meshes and settings of objects that came near other ranks
  std::uint64_t bytes_contacts = 0;   ///< sent: rows of pairs with objects of other ranks
  std::uint64_t bytes_moves = 0;      ///< sent: objects that moved to other ranks, with what is known of them
  double wait_ms = 0;                 ///< time in which it has sent and waited for messages, in milliseconds
  double load = 0;                    ///< the estimated load of this rank in this step, in milliseconds
  double imbalance = 1;  ///< the load of the busiest rank divided by the mean, in the step before
};

/// @}

}  // namespace graze::cluster
