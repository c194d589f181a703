#ifndef GRAZE_GRAZE_H
#define GRAZE_GRAZE_H

/// @file
/// The C interface of graze, in the library `graze_c`: meshes, scenes, reports, queries, evaluation of
/// contacts, recorders and replays. Other languages reach graze through it.
///
/// The comment of a function names the C++ function that it stands for, and the comment of that one says what
/// both do. Here stands where C is different. docs/c_interface.md has a whole program.
///
/// @par Errors
/// A function that can fail returns a #graze_status. If it is not #GRAZE_OK, the call has changed nothing,
/// and graze_last_error() has a sentence about it. No exception leaves the library. Where a function returns
/// a value or nothing, a null handle gives 0 or null.
///
/// @par Handles
/// A handle that a function gives in its last parameter belongs to the caller, who gives it to the function
/// `..._release` of its type. That takes null, too. Handles keep what they need: a mesh may be released as
/// soon as an object has it, and a report outlives its scene.
///
/// @par Structs that grow
/// A struct that the caller fills begins with `struct_size`. Call its `..._init` first, with the size that
/// the program was compiled with. A later library knows by that size which members the program has. Fields
/// that it does not have keep their defaults. Rows of reports have no size of their own: their layout changes
/// only with the number in the name of the library.
///
/// @par Numbers
/// Distances are in the caller's units. Positions and points are x, y, z. Enumerations are bytes with the
/// values of the constants below.

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// graze/version.hpp has the same three macros, so a program may include both.

/// The first number of the version of this header. It grows when programs have to change.
#define GRAZE_VERSION_MAJOR 0
/// The second number. While the first one is 0, programs may have to change where it grows.
#define GRAZE_VERSION_MINOR 2
/// The third number. No program has to change where it grows.
#define GRAZE_VERSION_PATCH 0

#if defined(GRAZE_C_BUILDING) && !defined(_WIN32)
#define GRAZE_C_API __attribute__((visibility("default")))
#elif defined(GRAZE_C_BUILDING)
#define GRAZE_C_API __declspec(dllexport)
#else
#define GRAZE_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// @addtogroup c_api
/// @{

/// @name Errors and the library
/// @{

/// Says how a call ended.
typedef int32_t graze_status;

enum {
  GRAZE_OK = 0,             ///< The call did what it says.
  GRAZE_REFUSED = 1,        ///< The C++ function throws graze::Error: the input is not what it takes.
  GRAZE_BAD_ARGUMENT = 2,   ///< A handle or a pointer is null, or a struct has a size that cannot be right.
  GRAZE_OUT_OF_MEMORY = 3,  ///< There was no memory.
  GRAZE_FAILED = 4,         ///< Anything else, such as a scheduler of the caller's that does not start.
};

/// Returns a sentence about the last call of this thread that did not return #GRAZE_OK. It is empty before
/// such a call. The text is valid until the next one.
GRAZE_C_API const char* graze_last_error(void);
/// Gives the version of the library: major, minor and patch. It may be newer than the `GRAZE_VERSION_MAJOR`,
/// `GRAZE_VERSION_MINOR` and `GRAZE_VERSION_PATCH` that a program was compiled with.
GRAZE_C_API void graze_library_version(int32_t version[3]);
/// Returns graze::max_threads().
GRAZE_C_API uint32_t graze_max_threads(void);
/// Returns the name of the instruction set in use, such as "avx2". See graze::instruction_set().
GRAZE_C_API const char* graze_instruction_set(void);
/// Chooses the instruction set of the process by its name, as graze::use_instruction_set() does.
GRAZE_C_API graze_status graze_use_instruction_set(const char* name);

/// @}

/// @name Enumerations
/// Each function returns an enumerator's name as in C++, or null for another value.
/// @{

enum { GRAZE_VERTEX, GRAZE_EDGE, GRAZE_FACE };                           ///< graze::FeatureKind
enum { GRAZE_VV, GRAZE_VE, GRAZE_VF, GRAZE_EE, GRAZE_EF, GRAZE_FF };     ///< graze::ContactKind
enum { GRAZE_SIDE_NONE, GRAZE_SIDE_FRONT, GRAZE_SIDE_BACK };             ///< graze::Side
enum { GRAZE_INSIDE_NONE, GRAZE_A_IN_B, GRAZE_B_IN_A, GRAZE_CROSSING };  ///< graze::Inside
enum { GRAZE_CERTAIN, GRAZE_POSSIBLE, GRAZE_AT_START };                  ///< graze::ImpactStatus
enum { GRAZE_NEAR, GRAZE_BEGAN, GRAZE_TOUCHING, GRAZE_ENDED };           ///< graze::PairPhase
enum { GRAZE_DEFORMABLE, GRAZE_RIGID, GRAZE_FIXED };                     ///< graze::Motion
enum { GRAZE_EVERY_STEP, GRAZE_WHEN_TOLD };                              ///< graze::BindPolicy
enum { GRAZE_ARENA_OWN, GRAZE_ARENA_CALLERS };                           ///< graze::ArenaPolicy
enum { GRAZE_EXACT, GRAZE_WITHIN, GRAZE_PAPER };                         ///< graze::AccuracyMode
enum { GRAZE_DROP, GRAZE_WAIT };                                         ///< graze::WhenBehind
/// graze::ContactDetail
enum {
  GRAZE_DETAIL_NONE,
  GRAZE_DETAIL_CLOSEST,
  GRAZE_DETAIL_REGIONS,
  GRAZE_DETAIL_VERTICES,
  GRAZE_DETAIL_FEATURES,
  GRAZE_DETAIL_NEAREST
};
/// graze::DiagnosticKind
enum {
  GRAZE_STALE_ID,
  GRAZE_WRONG_COUNT,
  GRAZE_NULL_MEMORY,
  GRAZE_MISALIGNED_MEMORY,
  GRAZE_WRONG_MOTION,
  GRAZE_BAD_POSE,
  GRAZE_NOT_FINITE,
  GRAZE_TOO_LARGE,
  GRAZE_BROKEN_PROMISE,
  GRAZE_BAD_PAIR,
  GRAZE_BAD_RULE,
  GRAZE_DIAGNOSTIC_OUT_OF_MEMORY
};

GRAZE_C_API const char* graze_feature_kind_name(uint8_t kind);
GRAZE_C_API const char* graze_contact_kind_name(uint8_t kind);
GRAZE_C_API const char* graze_side_name(uint8_t side);
GRAZE_C_API const char* graze_inside_name(uint8_t inside);
GRAZE_C_API const char* graze_impact_status_name(uint8_t status);
GRAZE_C_API const char* graze_pair_phase_name(uint8_t phase);
GRAZE_C_API const char* graze_motion_name(uint8_t motion);
GRAZE_C_API const char* graze_bind_policy_name(uint8_t policy);
GRAZE_C_API const char* graze_arena_policy_name(uint8_t policy);
GRAZE_C_API const char* graze_accuracy_mode_name(uint8_t mode);
GRAZE_C_API const char* graze_when_behind_name(uint8_t when);
GRAZE_C_API const char* graze_contact_detail_name(uint8_t detail);
GRAZE_C_API const char* graze_diagnostic_kind_name(uint8_t kind);

/// @}

/// @name Numbers and rows
/// The members are those of the C++ structs of the same names. Their comments say what they mean.
/// @{

/// graze::ObjectId. {0, 0} names no object.
typedef struct {
  uint32_t index;
  uint32_t generation;
} graze_id;

/// graze::Feature
typedef struct {
  uint8_t kind;
  uint32_t index;
} graze_feature;

/// graze::Contact
typedef struct {
  uint8_t kind;
  uint8_t side_a;
  uint8_t side_b;
  bool sunk;
  graze_feature feature_a;
  graze_feature feature_b;
  double point_a[3];
  double point_b[3];
  double normal[3];
  double distance;
  uint64_t since;
} graze_contact;

/// graze::DistanceBounds
typedef struct {
  double lower;
  double upper;
} graze_bounds;

/// graze::Witness
typedef struct {
  graze_feature feature_a;
  graze_feature feature_b;
  double point_a[3];
  double point_b[3];
} graze_witness;

/// graze::WayOut
typedef struct {
  double direction[3];
  double point[3];
  double fullness;
  double thickness;
  double extent;
} graze_way_out;

/// graze::PairReport
typedef struct {
  graze_id a;
  graze_id b;
  uint64_t user_data_a;
  uint64_t user_data_b;
  uint8_t phase;
  bool complete;
  bool stale;
  bool contacts_cut;
  uint8_t inside;
  graze_bounds distance;
  graze_witness witness;
  size_t first_contact;
  size_t contact_count;
  size_t first_region_distance;
  size_t region_distance_count;
  graze_way_out way_out;
  double time_of_impact;
  double time_of_gap;
  size_t first_impact;
  size_t impact_count;
} graze_pair;

/// graze::RegionDistance
typedef struct {
  uint32_t level;
  uint32_t region_a;
  uint32_t region_b;
  uint32_t vertex_a;
  uint32_t vertex_b;
  double point_a[3];
  double point_b[3];
  double distance;
} graze_region_distance;

/// graze::Impact
typedef struct {
  uint8_t kind;
  graze_feature feature_a;
  graze_feature feature_b;
  double lower;
  double upper;
  uint8_t status;
} graze_impact;

/// graze::Diagnostic. The message is valid as long as the report.
typedef struct {
  graze_id object;
  uint8_t kind;
  const char* message;
} graze_diagnostic;

/// graze::StepStatistics, with StepWork, StepBytes and StepTimes one after the other. The times are in
/// milliseconds.
typedef struct {
  uint64_t objects;
  uint64_t objects_unread;
  uint64_t objects_surveyed;
  uint64_t pairs_total;
  uint64_t objects_in_slack;
  uint64_t pairs_close;
  uint64_t pairs_filtered;
  uint64_t pairs_fixed;
  uint64_t pairs_by_layer;
  uint64_t pairs_in_group;
  uint64_t pairs_ignored;
  uint64_t pairs_apart;
  uint64_t pairs_unchanged;
  uint64_t pairs_tested;
  uint64_t pairs_by_list;
  uint64_t pairs_near;
  uint64_t pairs_in_contact;
  uint64_t contacts;
  uint64_t pairs_cut;
  uint64_t contacts_left_out;
  uint64_t region_distances;
  uint64_t region_distances_left_out;
  uint64_t pairs_swept;
  uint64_t impacts;
  uint64_t boxes_tested;
  uint64_t region_pairs_tested;
  uint64_t leaf_pairs_tested;
  uint64_t discarded_in_float;
  uint64_t named_in_float;
  uint64_t decided_in_double;
  uint64_t exact_decisions;
  uint64_t fronts_left_out;
  uint64_t regions_expanded[41];
  uint64_t swept_region_pairs;
  uint64_t swept_feature_pairs;
  uint64_t swept_exact_decisions;
  uint64_t object_bytes;
  uint64_t pair_bytes;
  uint64_t report_bytes;
  uint64_t thread_bytes;
  double read_ms;
  double pairs_ms;
  double refit_ms;
  double jobs_ms;
  double publish_ms;
  double step_ms;
} graze_statistics;

/// Positions in the caller's memory, as graze::PositionView.
typedef struct {
  /// The x of the first point: a float, or a double if #is_double.
  const void* first;
  /// How many points there are.
  size_t count;
  /// Bytes from the x of a point to the x of the next one. 0 stands for points without gaps.
  size_t stride_bytes;
  /// Bytes from x to y, and from y to z. 0 stands for coordinates without gaps.
  size_t coordinate_stride_bytes;
  /// Whether the numbers are doubles.
  bool is_double;
} graze_positions;

/// @}

/// @name Meshes
/// A graze_mesh is a graze::Mesh that any number of objects may share. It never changes, so any thread may
/// use it.
/// @{

typedef struct graze_mesh graze_mesh;

/// Makes a mesh from rest positions and three corners for each triangle, one after the other.
GRAZE_C_API graze_status graze_mesh_from_triangles(const graze_positions* rest, const uint32_t* corners,
                                                   size_t triangle_count, graze_mesh** mesh);
/// Makes a mesh from rest positions and four corners for each quad, one after the other.
GRAZE_C_API graze_status graze_mesh_from_quads(const graze_positions* rest, const uint32_t* corners,
                                               size_t quad_count, graze_mesh** mesh);
/// Makes a mesh of triangles and quads. `corner_counts` has 3 or 4 for each face.
GRAZE_C_API graze_status graze_mesh_from_polygons(const graze_positions* rest, const uint32_t* corners,
                                                  size_t corner_count, const uint32_t* corner_counts,
                                                  size_t face_count, graze_mesh** mesh);
/// Welds vertices that are at most `distance` apart, as graze::weld() does. Where `new_vertex_of_old` is not
/// null it takes a vertex of the new mesh for each old vertex. Where `new_face_of_old` is not null it takes a
/// face, or UINT32_MAX, for each old face.
GRAZE_C_API graze_status graze_mesh_weld(const graze_mesh* mesh, double distance, uint32_t* new_vertex_of_old,
                                         uint32_t* new_face_of_old, graze_mesh** welded);
/// Makes a second handle of the same mesh.
GRAZE_C_API graze_status graze_mesh_share(const graze_mesh* mesh, graze_mesh** shared);
GRAZE_C_API void graze_mesh_release(graze_mesh* mesh);

GRAZE_C_API uint32_t graze_mesh_vertex_count(const graze_mesh* mesh);
GRAZE_C_API uint32_t graze_mesh_face_count(const graze_mesh* mesh);
GRAZE_C_API uint32_t graze_mesh_edge_count(const graze_mesh* mesh);
/// Returns the number of corners of all faces together.
GRAZE_C_API size_t graze_mesh_corner_count(const graze_mesh* mesh);
/// Returns the rest positions: three doubles for each vertex. They are valid as long as any handle of the
/// mesh.
GRAZE_C_API const double* graze_mesh_rest(const graze_mesh* mesh);
/// Copies the corners of all faces one after the other, and the number of corners of each face. Either
/// pointer may be null.
GRAZE_C_API graze_status graze_mesh_faces(const graze_mesh* mesh, uint32_t* corners, uint32_t* corner_counts);
/// Copies for each corner of each face the edge to the next corner, or UINT32_MAX where there is none.
GRAZE_C_API graze_status graze_mesh_face_edges(const graze_mesh* mesh, uint32_t* edges);
/// Copies the two vertices of each edge, the lower one first.
GRAZE_C_API graze_status graze_mesh_edges(const graze_mesh* mesh, uint32_t* vertices);

/// The lists of graze::Mesh that a number of a vertex or an edge gives.
enum { GRAZE_VERTEX_NEIGHBOURS, GRAZE_VERTEX_FACES, GRAZE_EDGE_FACES };
/// Gives one of these lists for vertex or edge `index`. It is valid as long as any handle of the mesh.
GRAZE_C_API graze_status graze_mesh_list(const graze_mesh* mesh, uint8_t list, uint32_t index,
                                         const uint32_t** first, size_t* count);
/// Returns whether a face uses a vertex. It is false for a number that names no vertex.
GRAZE_C_API bool graze_mesh_is_used(const graze_mesh* mesh, uint32_t vertex);
GRAZE_C_API bool graze_mesh_uses_all_vertices(const graze_mesh* mesh);
GRAZE_C_API size_t graze_mesh_byte_count(const graze_mesh* mesh);

/// The lists of graze::MeshOddities.
enum {
  GRAZE_DEGENERATE_FACES,
  GRAZE_DUPLICATE_FACES,
  GRAZE_ISOLATED_VERTICES,
  GRAZE_DUPLICATE_VERTICES,
  GRAZE_NON_MANIFOLD_EDGES,
  GRAZE_BORDER_EDGES,
  GRAZE_FLIPPED_EDGES
};
/// Finds one of these lists. Copies as many as fit into `room` numbers at `found`, and gives in `count` how
/// many there are.
GRAZE_C_API graze_status graze_mesh_oddities(const graze_mesh* mesh, uint8_t list, uint32_t* found,
                                             size_t room, size_t* count);

/// @}

/// @name Settings
/// @{

/// Stands for no limit in a member that says so.
#define GRAZE_NO_LIMIT UINT64_MAX

/// graze::SceneSettings. Accuracy is three members, and limits that C++ leaves without a value are
/// #GRAZE_NO_LIMIT.
typedef struct {
  size_t struct_size;
  double contact_distance;
  double range;
  uint8_t detail;
  uint8_t accuracy;
  uint8_t arena;
  bool ways_out;
  /// Whether #carrying_band counts. Without it the threshold of each pair counts.
  bool has_carrying_band;
  uint32_t threads;
  /// For #GRAZE_WITHIN, and else 0.
  double tolerance;
  /// For #GRAZE_PAPER, and else null. It is copied.
  const double* epsilon;
  size_t epsilon_count;
  /// In microseconds, or #GRAZE_NO_LIMIT.
  uint64_t time_budget;
  uint64_t work_budget;
  uint64_t max_contacts;
  uint64_t max_contacts_per_pair;
  size_t region_distances;
  size_t carrying;
  double carrying_band;
  double sweep_tolerance;
  double swept_gap;
} graze_scene_settings;

/// graze::ObjectSettings. Pointers may be null where their count is 0. What they point at is copied.
typedef struct {
  size_t struct_size;
  /// Text in UTF-8 that ends with 0. Null is an empty name.
  const char* name;
  uint8_t motion;
  bool solid;
  bool self;
  bool self_at_rest;
  bool swept;
  bool queries;
  uint32_t layer;
  uint32_t collides_with;
  uint32_t kind;
  uint32_t self_rings;
  uint64_t group;
  double margin;
  uint64_t user_data;
  const uint8_t* face_groups;
  size_t face_group_count;
  const uint8_t* hidden_groups;
  size_t hidden_group_count;
  double patch_radius;
  uint32_t patch_faces;
} graze_object_settings;

/// graze::PairRule. What has no value stays that of the scene.
typedef struct {
  size_t struct_size;
  bool has_contact_distance;
  bool has_range;
  double contact_distance;
  double range;
  const double* epsilon;
  size_t epsilon_count;
} graze_pair_rule;

/// graze::SceneCapacity
typedef struct {
  size_t struct_size;
  size_t objects;
  size_t calls_per_step;
  size_t near_pairs;
  size_t contacts;
  size_t reports;
  size_t impacts;
} graze_scene_capacity;

GRAZE_C_API graze_status graze_scene_settings_init(graze_scene_settings* settings, size_t struct_size);
GRAZE_C_API graze_status graze_object_settings_init(graze_object_settings* settings, size_t struct_size);
GRAZE_C_API graze_status graze_pair_rule_init(graze_pair_rule* rule, size_t struct_size);
GRAZE_C_API graze_status graze_scene_capacity_init(graze_scene_capacity* capacity, size_t struct_size);

/// graze::TaskScheduler of the caller's. The functions are called from threads that step, and must not let an
/// exception out.
typedef struct {
  size_t struct_size;
  /// Given to each function.
  void* context;
  /// Calls `task(data, 0)` to `task(data, count - 1)`, each once, and returns when all have returned.
  void (*run)(void* context, uint32_t count, void (*task)(void* data, uint32_t index), void* data);
  /// Calls `work(data)` once on another thread, or before it returns. Returns false if it cannot, and then
  /// never calls it.
  bool (*start)(void* context, void (*work)(void* data), void* data);
  /// Called when the scene lets go of the scheduler, and not if graze_scene_new() fails. It may be null.
  void (*release)(void* context);
} graze_task_scheduler;

/// @}

/// @name Scenes
/// A graze_scene is a graze::Scene. Its thread rules are those of the C++ functions.
/// @{

typedef struct graze_scene graze_scene;
typedef struct graze_report graze_report;

/// Makes a scene. Null settings are the default ones. Without `scheduler` the scene takes oneTBB.
GRAZE_C_API graze_status graze_scene_new(const graze_scene_settings* settings,
                                         const graze_task_scheduler* scheduler, graze_scene** scene);
GRAZE_C_API void graze_scene_release(graze_scene* scene);
/// Gives the settings that the scene was made with. `settings` needs its `struct_size` only. `epsilon` is
/// valid as long as the scene.
GRAZE_C_API graze_status graze_scene_get_settings(const graze_scene* scene, graze_scene_settings* settings);

/// Scene::add(). Null settings are the default ones.
GRAZE_C_API graze_status graze_scene_add(graze_scene* scene, const graze_mesh* mesh,
                                         const graze_object_settings* settings, graze_id* object);
/// Scene::replace_mesh(). `new_of_old` has a vertex, or UINT32_MAX, for each vertex of the present mesh.
/// `face_groups` has one for each face of the new one, or is null.
GRAZE_C_API graze_status graze_scene_replace_mesh(graze_scene* scene, graze_id object, const graze_mesh* mesh,
                                                  const uint32_t* new_of_old, size_t new_of_old_count,
                                                  const uint8_t* face_groups, size_t face_group_count);
/// Scene::remove()
GRAZE_C_API graze_status graze_scene_remove(graze_scene* scene, graze_id object);
GRAZE_C_API size_t graze_scene_object_count(const graze_scene* scene);
GRAZE_C_API bool graze_scene_contains(const graze_scene* scene, graze_id object);
/// Scene::mesh(). The handle is null if the id names no object.
GRAZE_C_API graze_status graze_scene_mesh(const graze_scene* scene, graze_id object, graze_mesh** mesh);
/// Gives the settings of an object, or default ones. `settings` needs its `struct_size` only. The name and
/// the groups are valid until the next such call of this thread.
GRAZE_C_API graze_status graze_scene_get_object_settings(const graze_scene* scene, graze_id object,
                                                         graze_object_settings* settings);
/// Gives the name of an object. It is valid until the next such call of this thread.
GRAZE_C_API graze_status graze_scene_name(const graze_scene* scene, graze_id object, const char** name);

/// Scene::set_pose() of one or many objects. There are 12 doubles for each: the upper three rows of its 4 x 4
/// matrix, row by row. With `teleport` the objects jump.
GRAZE_C_API graze_status graze_scene_set_poses(graze_scene* scene, const graze_id* objects, size_t count,
                                               const double* rows, bool teleport);
/// Scene::set_pose_matrix() of each object, one after the other. There are 16 doubles for each: all rows of
/// its matrix for column vectors, row by row.
GRAZE_C_API graze_status graze_scene_set_pose_matrices(graze_scene* scene, const graze_id* objects,
                                                       size_t count, const double* rows);
/// Scene::set_positions() of one or many objects. `max_displacement` is INFINITY where nothing is promised.
GRAZE_C_API graze_status graze_scene_set_positions(graze_scene* scene, const graze_id* objects, size_t count,
                                                   const graze_positions* positions, double max_displacement);
/// Scene::set_positions() of one or many objects that jump.
GRAZE_C_API graze_status graze_scene_teleport_positions(graze_scene* scene, const graze_id* objects,
                                                        size_t count, const graze_positions* positions);
/// Scene::bind_positions() of one or many objects.
GRAZE_C_API graze_status graze_scene_bind_positions(graze_scene* scene, const graze_id* objects, size_t count,
                                                    const graze_positions* positions, uint8_t policy);
/// Scene::unbind_positions()
GRAZE_C_API graze_status graze_scene_unbind_positions(graze_scene* scene, graze_id object);
/// Scene::positions_changed() of one or many objects. `max_displacements` has one number for each. It may be
/// null: then nothing is promised.
GRAZE_C_API graze_status graze_scene_positions_changed(graze_scene* scene, const graze_id* objects,
                                                       size_t count, const double* max_displacements);
/// Scene::positions_changed() of one or many objects that jump.
GRAZE_C_API graze_status graze_scene_positions_jumped(graze_scene* scene, const graze_id* objects,
                                                      size_t count);

/// Scene::ignore() and Scene::watch() of a whole pair.
GRAZE_C_API graze_status graze_scene_ignore(graze_scene* scene, graze_id a, graze_id b);
GRAZE_C_API graze_status graze_scene_watch(graze_scene* scene, graze_id a, graze_id b);
/// Scene::ignore() and Scene::watch() of groups of faces.
GRAZE_C_API graze_status graze_scene_ignore_groups(graze_scene* scene, graze_id a, uint8_t group_a,
                                                   graze_id b, uint8_t group_b);
GRAZE_C_API graze_status graze_scene_watch_groups(graze_scene* scene, graze_id a, uint8_t group_a, graze_id b,
                                                  uint8_t group_b);
/// Scene::set_rule(). A null rule takes the last one back.
GRAZE_C_API graze_status graze_scene_set_rule(graze_scene* scene, uint32_t kind_a, uint32_t kind_b,
                                              const graze_pair_rule* rule);
/// Scene::reserve()
GRAZE_C_API graze_status graze_scene_reserve(graze_scene* scene, const graze_scene_capacity* capacity);

/// Scene::step(). `report` may be null. If `*report` is null it becomes a new handle. If it is a handle, that
/// lets go of its report and takes the new one. So a loop with one handle allocates none.
GRAZE_C_API graze_status graze_scene_step(graze_scene* scene, uint64_t tag, graze_report** report);
/// Scene::step_async()
GRAZE_C_API graze_status graze_scene_step_async(graze_scene* scene, uint64_t tag);
GRAZE_C_API bool graze_scene_is_stepping(const graze_scene* scene);
/// Scene::wait(), with `report` as in graze_scene_step().
GRAZE_C_API graze_status graze_scene_wait(graze_scene* scene, graze_report** report);
/// Scene::latest_report(), with `report` as in graze_scene_step(). With a handle to fill it is wait-free.
GRAZE_C_API graze_status graze_scene_latest_report(const graze_scene* scene, graze_report** report);

/// @}

/// @name Reports
/// A graze_report is a graze::ReportHandle. Its arrays are valid until it is released or given another
/// report. Any number of threads may read it meanwhile. `count` may be null.
/// @{

/// Makes a second handle of the same report.
GRAZE_C_API graze_status graze_report_share(const graze_report* report, graze_report** shared);
/// Copies the report, so that it no longer takes room of its scene.
GRAZE_C_API graze_status graze_report_copy(const graze_report* report, graze_report** copy);
GRAZE_C_API void graze_report_release(graze_report* report);

GRAZE_C_API uint64_t graze_report_frame(const graze_report* report);
GRAZE_C_API uint64_t graze_report_tag(const graze_report* report);
GRAZE_C_API bool graze_report_complete(const graze_report* report);
GRAZE_C_API const graze_pair* graze_report_pairs(const graze_report* report, size_t* count);
GRAZE_C_API const graze_contact* graze_report_contacts(const graze_report* report, size_t* count);
GRAZE_C_API const graze_region_distance* graze_report_region_distances(const graze_report* report,
                                                                       size_t* count);
GRAZE_C_API const graze_impact* graze_report_impacts(const graze_report* report, size_t* count);
GRAZE_C_API size_t graze_report_diagnostic_count(const graze_report* report);
/// Gives one diagnostic, by its index.
GRAZE_C_API graze_status graze_report_diagnostic(const graze_report* report, size_t index,
                                                 graze_diagnostic* diagnostic);
/// Fills as much of the statistics as `struct_size` bytes hold.
GRAZE_C_API graze_status graze_report_statistics(const graze_report* report, graze_statistics* statistics,
                                                 size_t struct_size);
/// FrameReport::mesh(). The handle is null where the report keeps no mesh of the object.
GRAZE_C_API graze_status graze_report_mesh(const graze_report* report, graze_id object, graze_mesh** mesh);
/// FrameReport::positions(). They are valid as long as the report. There are none where the report keeps
/// none.
GRAZE_C_API graze_status graze_report_positions(const graze_report* report, graze_id object,
                                                graze_positions* positions);

/// @}

/// @name Contacts at other positions
/// @{

/// graze::ContactGeometry
typedef struct {
  double point_a[3];
  double point_b[3];
  double normal[3];
  double push[3];
  double distance;
  double separation;
  uint8_t side_a;
  uint8_t side_b;
  bool sunk;
  bool is_interior;
} graze_contact_geometry;

/// graze::FollowedContact
typedef struct {
  graze_feature feature_a;
  graze_feature feature_b;
  graze_contact_geometry geometry;
  bool is_known;
  uint32_t steps;
} graze_followed_contact;

/// graze::SurfaceWeights
typedef struct {
  int32_t count;
  uint32_t vertex[4];
  double weight[4];
} graze_weights;

/// Gives Contact::separation() and Contact::push() of `count` contacts: a number and three numbers for each.
/// Either pointer may be null.
GRAZE_C_API graze_status graze_contact_separations(const graze_contact* contacts, size_t count,
                                                   double* separations, double* pushes);
/// graze::evaluate() of two features.
GRAZE_C_API graze_status graze_evaluate(const graze_mesh* mesh_a, const graze_positions* positions_a,
                                        graze_feature feature_a, const graze_mesh* mesh_b,
                                        const graze_positions* positions_b, graze_feature feature_b,
                                        graze_contact_geometry* geometry);
/// graze::evaluate() of `count` contacts of a report between the same two objects.
GRAZE_C_API graze_status graze_evaluate_contacts(const graze_mesh* mesh_a, const graze_positions* positions_a,
                                                 const graze_mesh* mesh_b, const graze_positions* positions_b,
                                                 const graze_contact* contacts, size_t count,
                                                 graze_contact_geometry* geometries);
/// graze::follow() of `count` contacts of a report between the same two objects. With `vertices_of_b` it is
/// graze::follow_vertex_of_b().
GRAZE_C_API graze_status graze_follow_contacts(const graze_mesh* mesh_a, const graze_positions* positions_a,
                                               const graze_mesh* mesh_b, const graze_positions* positions_b,
                                               const graze_contact* contacts, size_t count,
                                               bool vertices_of_b, graze_followed_contact* followed);
/// graze::weights()
GRAZE_C_API graze_status graze_surface_weights(const graze_mesh* mesh, const graze_positions* positions,
                                               graze_feature feature, const double point[3],
                                               graze_weights* weights);
/// graze::in_normal_cone()
GRAZE_C_API graze_status graze_in_normal_cone(const graze_mesh* mesh, const graze_positions* positions,
                                              graze_feature feature, const double direction[3],
                                              bool* is_in_cone);

/// @}

/// @name Two surfaces without a scene
/// @{

typedef struct graze_query graze_query;

/// graze::QuerySettings
typedef struct {
  size_t struct_size;
  double contact_distance;
  double range;
  uint8_t detail;
  uint8_t accuracy;
  bool a_is_solid;
  bool b_is_solid;
  bool ways_out;
  double tolerance;
  const double* epsilon;
  size_t epsilon_count;
  uint64_t max_contacts;
} graze_query_settings;

/// graze::QueryResult. The contacts are valid until the next question.
typedef struct {
  bool in_contact;
  bool is_in_range;
  bool contacts_cut;
  uint8_t inside;
  graze_bounds distance;
  graze_witness witness;
  graze_way_out way_out;
  const graze_contact* contacts;
  size_t contact_count;
} graze_query_result;

GRAZE_C_API graze_status graze_query_settings_init(graze_query_settings* settings, size_t struct_size);
/// Makes a graze::RepeatedQuery. Null settings are the default ones.
GRAZE_C_API graze_status graze_query_new(const graze_mesh* mesh_a, const graze_mesh* mesh_b,
                                         const graze_query_settings* settings, graze_query** query);
/// RepeatedQuery::ask(). The answer has the bits of graze::query().
GRAZE_C_API graze_status graze_query_ask(graze_query* query, const graze_positions* positions_a,
                                         const graze_positions* positions_b, graze_query_result* result);
GRAZE_C_API void graze_query_release(graze_query* query);

/// @}

/// @name Patches
/// What lies around an object with patch_radius, for answers between steps: graze::Patch. It is named by its
/// report and the object, its tool. Any number of threads may ask about one report, each with a room of its
/// own. A copy of a report has its patches, too. A tool without a patch is refused, but for
/// graze_report_patch().
/// @{

/// graze::PatchRoom
typedef struct graze_patch_room graze_patch_room;

/// graze::PatchPair
typedef struct {
  graze_id a;
  graze_id b;
  uint8_t inside;
  size_t first_contact;
  size_t contact_count;
} graze_patch_pair;

/// graze::PatchAnswer
typedef struct {
  bool complete;
  double threshold;
  double validity;
} graze_patch_answer;

/// The members of a graze::Patch that need no further question. `exists` is false where the report has no
/// patch of the tool.
typedef struct {
  bool exists;
  bool is_cut;
  double radius;
  size_t face_count;
  /// In the order in which they were added. They are valid as long as the report.
  const graze_id* objects;
  size_t object_count;
} graze_patch;

/// FrameReport::patch()
GRAZE_C_API graze_status graze_report_patch(const graze_report* report, graze_id tool, graze_patch* patch);
/// Patch::faces(). They are valid as long as the report.
GRAZE_C_API graze_status graze_patch_faces(const graze_report* report, graze_id tool, graze_id object,
                                           const uint32_t** faces, size_t* count);
/// Patch::positions(). They are valid as long as the report.
GRAZE_C_API graze_status graze_patch_positions(const graze_report* report, graze_id tool, graze_id object,
                                               graze_positions* positions);
/// Patch::contacts() at a pose: its rows, of three times four numbers.
GRAZE_C_API graze_status graze_patch_contacts_at_pose(const graze_report* report, graze_id tool,
                                                      const double rows[12], double threshold,
                                                      graze_patch_room* room, graze_patch_answer* answer);
/// Patch::contacts() at positions
GRAZE_C_API graze_status graze_patch_contacts_at_positions(const graze_report* report, graze_id tool,
                                                           const graze_positions* positions, double threshold,
                                                           graze_patch_room* room,
                                                           graze_patch_answer* answer);
/// Patch::validity() at a pose. Without a threshold, null, it is the largest of the scene.
GRAZE_C_API graze_status graze_patch_validity_at_pose(const graze_report* report, graze_id tool,
                                                      const double rows[12], const double* threshold,
                                                      double* validity);
/// Patch::validity() at positions
GRAZE_C_API graze_status graze_patch_validity_at_positions(const graze_report* report, graze_id tool,
                                                           const graze_positions* positions,
                                                           const double* threshold, double* validity);
/// Makes a room that has no memory yet.
GRAZE_C_API graze_status graze_patch_room_new(graze_patch_room** room);
GRAZE_C_API void graze_patch_room_release(graze_patch_room* room);
/// PatchRoom::pairs(). They are valid until the room is filled again.
GRAZE_C_API const graze_patch_pair* graze_patch_room_pairs(const graze_patch_room* room, size_t* count);
/// PatchRoom::contacts(). They are valid until the room is filled again.
GRAZE_C_API const graze_contact* graze_patch_room_contacts(const graze_patch_room* room, size_t* count);

/// @}

/// @name Questions about a report
/// A graze_scene_query is a graze::SceneQuery, and a graze_probe a graze::MeshProbe. One thread at a time may
/// use either. Functions that fill a list give in `count` how many there are of what `room` has place for.
/// Only graze_scene_query_blocking() and graze_scene_query_objects_in_box() count what has no place, too. A
/// null filter leaves out nothing.
/// @{

typedef struct graze_scene_query graze_scene_query;
typedef struct graze_probe graze_probe;

/// graze::QueryFilter
typedef struct {
  uint32_t layer;
  uint32_t collides_with;
  graze_id ignored;
} graze_query_filter;

/// graze::RayHit
typedef struct {
  graze_id object;
  double t;
  double point[3];
  double normal[3];
  graze_feature feature;
  uint32_t face;
  uint8_t triangle;
} graze_ray_hit;

/// graze::SphereHit
typedef struct {
  graze_id object;
  double t;
  double centre[3];
  double point[3];
  double normal[3];
  graze_feature feature;
} graze_sphere_hit;

/// graze::ClosestPoint
typedef struct {
  graze_id object;
  double distance;
  double point[3];
  double normal[3];
  graze_feature feature;
  uint8_t side;
} graze_closest_point;

/// Makes a query about a report. Null asks about no objects. A report that graze_report_copy() made is
/// refused.
GRAZE_C_API graze_status graze_scene_query_new(const graze_report* report, graze_scene_query** query);
GRAZE_C_API graze_status graze_scene_query_set_report(graze_scene_query* query, const graze_report* report);
/// Gives the report that is asked about, with `report` as in graze_scene_step(). The handle becomes null
/// where there is none.
GRAZE_C_API graze_status graze_scene_query_report(const graze_scene_query* query, graze_report** report);
GRAZE_C_API void graze_scene_query_release(graze_scene_query* query);
/// SceneQuery::cast_ray() for the first `room` hits. `limit` may be INFINITY.
GRAZE_C_API graze_status graze_scene_query_cast_ray(graze_scene_query* query, const double origin[3],
                                                    const double direction[3], double limit,
                                                    const graze_query_filter* filter, graze_ray_hit* hits,
                                                    size_t room, size_t* count);
/// SceneQuery::cast_sphere() for the first `room` objects.
GRAZE_C_API graze_status graze_scene_query_cast_sphere(graze_scene_query* query, const double from[3],
                                                       const double to[3], double radius,
                                                       const graze_query_filter* filter,
                                                       graze_sphere_hit* hits, size_t room, size_t* count);
/// SceneQuery::closest_points() of the nearest `room` objects.
GRAZE_C_API graze_status graze_scene_query_closest_points(graze_scene_query* query, const double point[3],
                                                          double limit, const graze_query_filter* filter,
                                                          graze_closest_point* points, size_t room,
                                                          size_t* count);
/// SceneQuery::is_free()
GRAZE_C_API graze_status graze_scene_query_is_free(graze_scene_query* query, graze_probe* probe,
                                                   double clearance, const graze_query_filter* filter,
                                                   bool* is_free);
/// SceneQuery::blocking()
GRAZE_C_API graze_status graze_scene_query_blocking(graze_scene_query* query, graze_probe* probe,
                                                    double clearance, const graze_query_filter* filter,
                                                    graze_id* objects, size_t room, size_t* count);
/// SceneQuery::objects_in_box()
GRAZE_C_API graze_status graze_scene_query_objects_in_box(graze_scene_query* query, const double min[3],
                                                          const double max[3],
                                                          const graze_query_filter* filter, graze_id* objects,
                                                          size_t room, size_t* count);

GRAZE_C_API graze_status graze_probe_new(const graze_mesh* mesh, bool solid, graze_probe** probe);
/// MeshProbe::set_pose(), by the upper three rows of the matrix, row by row.
GRAZE_C_API graze_status graze_probe_set_pose(graze_probe* probe, const double rows[12]);
GRAZE_C_API graze_status graze_probe_set_positions(graze_probe* probe, const graze_positions* positions);
GRAZE_C_API void graze_probe_release(graze_probe* probe);

/// @}

/// @name Recording
/// Paths are text in the encoding that fopen() takes.
/// @{

typedef struct graze_recorder graze_recorder;

/// graze::RecorderSettings and graze::RingSettings. The last three members count for a ring.
typedef struct {
  size_t struct_size;
  uint32_t keyframe_interval;
  uint32_t waiting_frames;
  uint8_t when_behind;
  size_t byte_budget;
  /// The frames that are wanted at least, or #GRAZE_NO_LIMIT for as many as fit.
  uint64_t frames;
  /// Null stands for none.
  const char* on_diagnostic;
} graze_recorder_settings;

/// graze::RecorderStatistics
typedef struct {
  uint64_t frames;
  uint64_t dropped;
  uint64_t bytes;
} graze_recorder_statistics;

GRAZE_C_API graze_status graze_recorder_settings_init(graze_recorder_settings* settings, size_t struct_size);
/// Records into a file. Null settings are the default ones.
GRAZE_C_API graze_status graze_recorder_new(graze_scene* scene, const char* file,
                                            const graze_recorder_settings* settings,
                                            graze_recorder** recorder);
/// Keeps the last frames in memory.
GRAZE_C_API graze_status graze_recorder_new_ring(graze_scene* scene, const graze_recorder_settings* settings,
                                                 graze_recorder** recorder);
/// Recorder::close()
GRAZE_C_API graze_status graze_recorder_close(graze_recorder* recorder);
/// Recorder::write(). `statistics` may be null.
GRAZE_C_API graze_status graze_recorder_write(graze_recorder* recorder, const char* file,
                                              graze_recorder_statistics* statistics);
GRAZE_C_API graze_status graze_recorder_get_statistics(const graze_recorder* recorder,
                                                       graze_recorder_statistics* statistics);
/// Detaches and frees the recorder. Call graze_recorder_close() first to be told of what goes wrong.
GRAZE_C_API void graze_recorder_release(graze_recorder* recorder);

/// @}

/// @name Reading recordings
/// @{

typedef struct graze_recording graze_recording;
typedef struct graze_replay graze_replay;

/// graze::RecordedFrame
typedef struct {
  uint64_t frame;
  uint64_t tag;
  size_t pairs;
  size_t pairs_in_contact;
  uint64_t contacts;
  uint64_t diagnostics;
  uint64_t dropped_before;
  bool has_keyframe;
  bool complete;
  double step_ms;
} graze_recorded_frame;

/// graze::ReplayDifference. The texts are valid until the next step.
typedef struct {
  uint64_t frame;
  const char* pair;
  const char* recorded;
  const char* replayed;
} graze_replay_difference;

/// Opens a recording. Replays keep what they need of it. One thread at a time may use a recording and its
/// replays.
GRAZE_C_API graze_status graze_recording_open(const char* file, graze_recording** recording);
GRAZE_C_API void graze_recording_release(graze_recording* recording);
/// Gives the settings of the recorded scene. `settings` needs its `struct_size` only. `epsilon` is valid as
/// long as the recording.
GRAZE_C_API graze_status graze_recording_settings(const graze_recording* recording,
                                                  graze_scene_settings* settings);
GRAZE_C_API const char* graze_recording_made_by(const graze_recording* recording);
GRAZE_C_API bool graze_recording_is_finished(const graze_recording* recording);
GRAZE_C_API bool graze_recording_is_cut(const graze_recording* recording);
GRAZE_C_API size_t graze_recording_frame_count(const graze_recording* recording);
GRAZE_C_API graze_status graze_recording_frame(const graze_recording* recording, size_t index,
                                               graze_recorded_frame* frame);
GRAZE_C_API uint64_t graze_recording_dropped_at_end(const graze_recording* recording);
GRAZE_C_API size_t graze_recording_mesh_count(const graze_recording* recording);
GRAZE_C_API uint64_t graze_recording_byte_count(const graze_recording* recording);
/// Recording::check()
GRAZE_C_API graze_status graze_recording_check(const graze_recording* recording);
/// graze::cut_recording(). Without serials all objects are kept.
GRAZE_C_API graze_status graze_recording_cut(const graze_recording* recording, size_t first_frame,
                                             size_t last_frame, const uint64_t* serials, size_t serial_count,
                                             const char* file);

/// Makes a replay that begins at frame `first_frame`. It uses `threads` threads, or as many as were recorded
/// if that is UINT32_MAX.
GRAZE_C_API graze_status graze_replay_new(const graze_recording* recording, size_t first_frame,
                                          uint32_t threads, graze_replay** replay);
GRAZE_C_API void graze_replay_release(graze_replay* replay);
/// Replay::step(). `has_stepped` becomes false where there is no further frame.
GRAZE_C_API graze_status graze_replay_step(graze_replay* replay, bool* has_stepped);
GRAZE_C_API size_t graze_replay_frame_index(const graze_replay* replay);
/// Gives the report of the last step, with `report` as in graze_scene_step().
GRAZE_C_API graze_status graze_replay_report(const graze_replay* replay, graze_report** report);
/// Gives how the last step differs from the recording. Returns whether it does.
GRAZE_C_API bool graze_replay_get_difference(const graze_replay* replay, graze_replay_difference* difference);
GRAZE_C_API size_t graze_replay_rows_not_compared(const graze_replay* replay);
GRAZE_C_API size_t graze_replay_rows_compared_in_part(const graze_replay* replay);
GRAZE_C_API size_t graze_replay_object_count(const graze_replay* replay);
/// Gives an object by its index: its id, its serial, its mesh and its settings. Each pointer may be null.
/// `settings` needs its `struct_size` only. Name and groups are valid until the next step.
GRAZE_C_API graze_status graze_replay_object(const graze_replay* replay, size_t index, graze_id* object,
                                             uint64_t* serial, graze_mesh** mesh,
                                             graze_object_settings* settings);
/// Copies the positions of an object's vertices: three doubles for each.
GRAZE_C_API graze_status graze_replay_positions(const graze_replay* replay, size_t index, double* positions,
                                                size_t vertex_count);
/// Copies the pose of a rigid or fixed object: the upper three rows of its matrix, row by row.
GRAZE_C_API graze_status graze_replay_pose(const graze_replay* replay, size_t index, double rows[12]);

/// @}

/// @}

#ifdef __cplusplus
}
#endif

#endif
