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

/// @addtogroup settings
/// @{

/// Says how an object may move. Pairs of two fixed objects are never tested.
enum class Motion : std::uint8_t {
  deformable,  ///< Its vertices move one by one: Scene::set_positions() or Scene::bind_positions() move it.
  rigid,       ///< It moves as a whole: Scene::set_pose() moves it.
  fixed,       ///< Scene::set_pose() places it, as a rigid object, but it is a part of the surroundings.
};

/// Says when a step reads bound memory, see Scene::bind_positions().
enum class BindPolicy : std::uint8_t {
  every_step,  ///< Every step reads the memory.
  when_told,   ///< Only steps after Scene::positions_changed() read the memory.
};

/// Says in which arena of oneTBB a step runs its tasks. It has no effect if the scene has a TaskScheduler.
enum class ArenaPolicy : std::uint8_t {
  own,      ///< The scene has an arena of its own, with SceneSettings::threads threads.
  callers,  ///< Tasks run in the arena of the thread that calls Scene::step(), at most as many at once as it
            ///< has.
};

/// The most that ObjectSettings::self_rings may be. More edges than this make no neighbourhood, and take long
/// to follow.
inline constexpr std::uint32_t most_self_rings = 8;

/// Describes one object to Scene::add(). The settings of an object never change.
struct ObjectSettings {
  /// A name for people. Messages use it. Names may repeat or be empty.
  std::string name = {};
  /// How the object may move.
  Motion motion = Motion::deformable;
  /// A set of bits. A pair is tested if each object's layer has a bit of the other's #collides_with.
  std::uint32_t layer = 1;
  /// A set of bits: the layers that this object is tested with. All bits are set by default.
  std::uint32_t collides_with = ~std::uint32_t{0};
  /// Two objects of one group are not tested against each other, such as the parts of one character. 0
  /// means no group.
  std::uint64_t group = 0;
  /// A distance that is added to the threshold of every pair of this object. It is finite, and 0 or more.
  double margin = 0;
  /// The kind of the object, 0 to 255. Scene::set_rule() gives thresholds to pairs of kinds.
  std::uint32_t kind = 0;
  /// Whether the surface bounds a volume. Then reports say what is inside of it: PairReport::inside. A pair
  /// of which a vertex is inside the other's volume is in contact, however deep. With ContactDetail::nearest
  /// each such vertex has a contact, with the way out. The surface has to be closed: each edge has two faces,
  /// which pass it in opposite directions. It counts in the details `none`, `closest`, `features` and
  /// `nearest`.
  bool solid = false;
  /// Any number of the caller's. Reports give it back in PairReport::user_data_a and PairReport::user_data_b.
  std::uint64_t user_data = 0;
  /// The group of each face, 0 to 255, in the order of the mesh's faces. It has one number for each face, or
  /// is empty: then all faces are in group 0. A form of Scene::ignore() takes out the faces of one group
  /// against those of another.
  std::vector<std::uint8_t> face_groups = {};
  /// The groups of #face_groups whose faces are tested against nothing, such as the inner walls between tiles
  /// that lie side by side. Order and repetitions do not matter. A hidden face still bounds a solid.
  ///
  /// An edge between a hidden face and one that is seen is tested with the seen face alone. The seen face is
  /// taken to go on behind the edge in its plane, so that the edge is neither a border nor a crease.
  std::vector<std::uint8_t> hidden_groups = {};
  /// Whether the surface is tested against itself: the pair (id, id) has a row of its own, as two objects
  /// have. It has an effect with all details but `regions`, and not with Accuracy::paper(). Layers, groups
  /// and #motion do not take this pair out. What a #solid or SceneSettings::ways_out adds does not go with
  /// it.
  ///
  /// A contact names two features of the surface, the lower as `feature_a`. Features that belong together are
  /// not tested: see #self_rings and #self_at_rest. An edge that pierces a face counts wherever the two share
  /// no vertex.
  bool self = false;
  /// With #self: two features are not tested if a vertex of one is joined to a vertex of the other by this
  /// many edges or fewer. With 0 only features that share a vertex are left out. It is at most
  /// #most_self_rings.
  std::uint32_t self_rings = 1;
  /// With #self: whether features are tested that are nearer than the threshold at rest. A mesh finer than
  /// the threshold would then touch itself everywhere.
  bool self_at_rest = false;
  /// Whether reports say what the object meets between two steps. A pair is swept if one of its objects is.
  /// Then every vertex of both objects counts as moving along a straight line from where the last step saw
  /// it, and FrameReport::impacts() lists what meets on the way. A pair that meets on the way is listed.
  ///
  /// Also a rigid object's vertices move straight from pose to pose. An object stands at its new place in its
  /// first step, after a `teleport`, and when its mesh was replaced. A fixed object always stands.
  bool swept = false;
  /// Whether reports keep this object's positions: FrameReport::positions(), and what SceneQuery finds. A
  /// step in which the object moved copies its positions and computes the boxes of its regions once more. The
  /// object is then read in every step, however far it is from others.
  bool queries = false;
  /// If it is above 0, reports keep a patch around this object, for answers between steps: a copy of all
  /// faces of other objects within this distance. FrameReport::patch() gives it. It is finite, and 0 or more.
  ///
  /// Each step copies the faces near the object that have moved, and all of a solid near it. The object and
  /// those within the distance are read, also where a promise would leave them unread.
  double patch_radius = 0;
  /// The most faces that a patch has of all objects together, at least 1. If there are more within the
  /// radius, the patch has the nearest, by whole leaves, and says so: Patch::is_cut(). A solid is copied
  /// whole, and of its faces those within the radius count.
  std::uint32_t patch_faces = 16384;
};

/// Gives thresholds to the pairs of two kinds of objects, see Scene::set_rule(). They replace those of the
/// scene. What a rule does not name stays that of the scene, so an empty rule takes the last one back. This
/// is how experiment 2 of the paper uses its equation 6.
struct PairRule {
  /// Replaces SceneSettings::contact_distance. It is finite, and 0 or more.
  std::optional<double> contact_distance = {};
  /// Replaces SceneSettings::range. It is 0 or more, and may be infinite.
  std::optional<double> range = {};
  /// Replaces the numbers of Accuracy::paper(). If it is empty, the scene's own numbers count.
  std::vector<double> epsilon = {};
};

/// Returns the largest number of threads that a scene uses: 8 for each processor that this process may run
/// on. More threads would only wait for each other, and each of them holds memory.
[[nodiscard]] GRAZE_API unsigned max_threads();

/// The settings of a scene. They are fixed when the scene is made. Distances are in the caller's units.
struct SceneSettings {
  /// Features that are strictly closer than the threshold are in contact. The threshold of a pair is this
  /// distance plus the margins of both objects. It is finite, and 0 or more.
  double contact_distance = 0;
  /// The report lists pairs that are strictly closer than this, with their distance. It is 0 or more, and may
  /// be infinite. Pairs below their threshold are listed anyway.
  double range = 0;
  /// Selects what a report lists for each pair in contact.
  ContactDetail detail = ContactDetail::features;
  /// How exact the answers are.
  Accuracy accuracy = Accuracy::exact();
  /// How many threads a step uses. 0 means one for each processor. 1 means that the thread that calls
  /// Scene::step() does all the work. Numbers above max_threads() count as max_threads(). A scene with a
  /// TaskScheduler should have as many as that uses. Without oneTBB and without one it is 1. Answers do not
  /// depend on it.
  unsigned threads = 0;
  /// In which arena of oneTBB a step runs its tasks.
  ArenaPolicy arena = ArenaPolicy::own;
  /// The time that a step may take until it stops testing pairs, 0 or more. Positions are always read and
  /// bounds refreshed first. Then pairs come in order of urgency: pairs in contact, then the smallest lower
  /// bound. Pairs without an answer have PairReport::complete false. No value means no limit.
  std::optional<std::chrono::microseconds> time_budget = std::nullopt;
  /// The number of region pairs that a step may test. It limits the work as #time_budget does, but the
  /// answers are the same in every run. No value means no limit.
  std::optional<std::uint64_t> work_budget = std::nullopt;
  /// The most contacts that a report lists, of all pairs together. It is at least 1. No value means no limit.
  ///
  /// The report keeps the nearest contacts: by reported distance, then by the order of the pairs, then by
  /// kind and features. With ContactDetail::nearest it keeps the deepest: by Contact::separation() in place
  /// of the distance, and edges that pierce come last. A pair that loses contacts has
  /// PairReport::contacts_cut true and PairReport::complete false. Its phase, distance and witness are those
  /// of all its contacts. Memory follows the number of contacts kept, but with ContactDetail::nearest that of
  /// all contacts of a pair.
  std::optional<std::size_t> max_contacts = std::nullopt;
  /// The most contacts that a report lists for each pair. It is at least 1. No value means no limit. The
  /// report keeps the nearest contacts of the pair: by reported distance, then by kind and features. With
  /// ContactDetail::nearest it keeps the deepest, as #max_contacts does.
  std::optional<std::size_t> max_contacts_per_pair = std::nullopt;
  /// The most region distances that a report lists, of all pairs together. They are the paper's cd: the red,
  /// green and blue lines of its figure 7. 0 means that none are looked for.
  ///
  /// Each pair that is tested has an equal share, which is filled level by level. The step counts what
  /// finds no room in StepStatistics::region_distances_left_out. The distances of each pair cost a walk of
  /// their own.
  std::size_t region_distances = 0;
  /// Whether reports say how objects leave each other whose surfaces pass through each other:
  /// PairReport::way_out. It takes time only for such pairs. It has no effect with the details `vertices` and
  /// `regions`.
  bool ways_out = false;
  /// The most contacts that a report lists for each pair, chosen to carry it. 0 means no limit. It has an
  /// effect with ContactDetail::nearest only. PairReport::contacts_cut does not count what it leaves out.
  ///
  /// One of the deepest leads. The others span most of what is at most #carrying_band less deep and pushes
  /// within 26° of it. From 6 on, some may push another way. Contacts that the last report listed are
  /// preferred, so that the list does not jump when a body trembles. Edges that pierce carry nothing, and are
  /// listed only for a pair that has no other contact. docs/answers.md has the whole rule.
  std::size_t carrying = 0;
  /// How much less deep than the deepest a contact may be that #carrying chooses. It is finite, and 0 or
  /// more. No value means the threshold of the pair.
  std::optional<double> carrying_band = std::nullopt;
  /// The bounds of an impact's time are at most this far apart, where a whole step takes time 1. It is at
  /// least 2^-52, and at most 1. It counts for swept pairs (ObjectSettings::swept).
  double sweep_tolerance = 1e-6;
  /// Reports say of swept pairs when their surfaces come that near: PairReport::time_of_gap. A pair that
  /// comes that near on the way is listed. It is finite, and 0 or more. With 0 nothing is asked.
  double swept_gap = 0;
};

/// Says how much room Scene::reserve() makes ahead of time.
struct SceneCapacity {
  /// The number of objects.
  std::size_t objects = 0;
  /// The number of calls that are made between two steps. Each object of a call for many objects counts as
  /// one.
  std::size_t calls_per_step = 0;
  /// The number of pairs that StepStatistics::pairs_close counts, or that the last report listed.
  ///
  /// Each of these pairs gets room for its search, its answer, and its row in a report. It also gets memory
  /// from step to step: for 64 pairs of leaves, and for four pairs of features for each of its share of
  /// #contacts.
  ///
  /// If the number is not 0, each object also gets room for the bounds of its regions, even if it is added
  /// later. Each thread gets room for a pair of 1,024 contacts, 1,024 leaf pairs, and 1,024 contacts at the
  /// least distance. If an object is a solid, it also gets room for 8,192 edges that touch another surface.
  /// With SceneSettings::ways_out it gets room for 4,096 places where an edge crosses a face.
  std::size_t near_pairs = 0;
  /// The number of contacts of all pairs together, in the answers of a step and in a report.
  std::size_t contacts = 0;
  /// The number of reports that handles hold at the same time, in addition to the latest one. Each gets room
  /// for #near_pairs rows, #contacts contacts and #impacts impacts, or as much as any report has needed.
  std::size_t reports = 0;
  /// The number of impacts of all swept pairs together, in the answers of a step and in a report.
  ///
  /// If neither this nor #near_pairs is 0, #near_pairs also counts the pairs that StepStatistics::pairs_swept
  /// counts. Each object that may be in a swept pair gets room for its positions of the last step and for the
  /// bounds of its way, even if it is added later. Each thread gets room for 1,024 impacts of a pair.
  std::size_t impacts = 0;
};

/// @}

}  // namespace graze
