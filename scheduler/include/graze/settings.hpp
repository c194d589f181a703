#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <graze/accuracy.hpp>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <optional>
#include <string>
#include <vector>

namespace graze {

/// How an object may move: `deformable` by positions, `rigid` and `fixed` by poses. Pairs of fixed objects
/// are never looked at.
enum class Motion : std::uint8_t { deformable, rigid, fixed };

/// When bound memory is read: in every step, or only in the step after `Scene::positions_changed`.
enum class BindPolicy : std::uint8_t { every_step, when_told };

/// Where a step's tasks run: in an arena of the scene's own, or in the one of the thread that calls `step`,
/// at most as many at once as that has threads.
enum class ArenaPolicy : std::uint8_t { own, callers };

/// What a scene is told of an object when it is added.
struct ObjectSettings {
  std::string name = {};
  Motion motion = Motion::deformable;
  std::uint32_t layer = 1;  ///< a pair is looked at when each one's layer is in the other's mask
  std::uint32_t collides_with = ~std::uint32_t{0};
  /// Objects of one group are not looked at against each other: the parts of one character, say. 0: no group.
  std::uint64_t group = 0;
  double margin = 0;       ///< added to the threshold of every pair of this object
  std::uint32_t kind = 0;  ///< 0 to 255, see Scene::set_rule
  std::uint64_t user_data = 0;
};

/// Thresholds for a kind of pair, in place of the scene's own.
struct PairRule {
  double contact_distance = 0;
  double range = 0;
  std::vector<double> epsilon = {};  ///< in place of Accuracy::paper's numbers; empty: the scene's own
};

/// The most threads that a scene uses: 8 for each processor that this process may run on. More would only
/// wait for each other, and each of them holds memory.
[[nodiscard]] GRAZE_API unsigned max_threads();

/// Settings of a scene, fixed when it is made. Distances are in the caller's units.
struct SceneSettings {
  double contact_distance = 0;  ///< strictly closer than this, plus both margins, is a contact
  double range = 0;             ///< pairs closer than this are listed with their distance
  ContactDetail detail = ContactDetail::features;
  Accuracy accuracy = Accuracy::exact();
  /// How many threads a step uses. 0: one for each processor. 1: all is done on the thread that calls `step`.
  /// More than `max_threads()` count as so many. Answers do not depend on it.
  unsigned threads = 0;
  ArenaPolicy arena = ArenaPolicy::own;
  /// A step's deadline for pairs; positions are always read and bounds refreshed first.
  std::optional<std::chrono::microseconds> time_budget = std::nullopt;
  /// The same in region pairs, reproducibly.
  std::optional<std::uint64_t> work_budget = std::nullopt;
  /// At most so many contacts a report has, of all pairs together: the nearest, by (distance as reported,
  /// order of the pairs, kind and features). A pair that has more than are kept of it is reported with these,
  /// `complete == false` and `contacts_cut`; its phase, distance and witness are those of all its contacts.
  /// Memory follows what is kept. At least 1.
  std::optional<std::size_t> max_contacts = std::nullopt;
  /// The same of each pair: its nearest, by (distance as reported, kind and features).
  std::optional<std::size_t> max_contacts_per_pair = std::nullopt;
  /// How many distances of regions (the paper's cd and its red, green and blue lines) reports list, of all
  /// pairs together; 0: none are looked for. Each pair looked at has an equal share of it, filled level by
  /// level; what has no place is counted in StepStatistics::region_distances_left_out.
  std::size_t region_distances = 0;
};

/// How much a scene makes room for ahead of time; see Scene::reserve.
struct SceneCapacity {
  std::size_t objects = 0;
  std::size_t calls_per_step = 0;  ///< made between two steps; each object of a batch is one
  /// Pairs near enough that StepStatistics::pairs_close counts them, or that the last report listed. Each has
  /// its job, its answer, its memory between steps with room for 64 pairs of leaves and for four pairs of
  /// features for each contact that is its part of `contacts`, and its row in a report.
  /// Where this is not 0 objects, those that come later too, have room for the bounds of their regions, and
  /// each thread for a pair of 1,024 contacts, leaf pairs, and contacts at the least distance.
  std::size_t near_pairs = 0;
  /// Of all pairs together: in the answers of a step, and in a report.
  std::size_t contacts = 0;
  /// Held by handles at once, beside the latest. Each has room for `near_pairs` rows and `contacts`, or as
  /// much as any report has needed.
  std::size_t reports = 0;
};

}  // namespace graze
