#include "settings.hpp"

#include <chrono>
#include <limits>

namespace graze::c {
namespace {

/// No struct of settings comes near this many bytes.
constexpr std::size_t most_struct_bytes = 4096;

template <typename Number>
std::uint64_t limit_to_c(const std::optional<Number>& limit) {
  return limit ? static_cast<std::uint64_t>(*limit) : GRAZE_NO_LIMIT;
}

template <typename Number>
std::optional<Number> limit_from_c(std::uint64_t limit) {
  if (limit == GRAZE_NO_LIMIT) return std::nullopt;
  return static_cast<Number>(limit);
}

/// Returns the accuracy that the members of settings say. Bad numbers are refused where it is made, and here
/// what has no effect.
template <typename Struct>
Accuracy accuracy_from_c(const Struct& settings) {
  const auto numbers = array(settings.epsilon, settings.epsilon_count, "epsilon");
  if (settings.accuracy != GRAZE_WITHIN && settings.tolerance != 0)
    throw BadArgument("settings: a tolerance goes with the accuracy within only");
  if (settings.accuracy != GRAZE_PAPER && !numbers.empty())
    throw BadArgument("settings: numbers of levels go with the paper's accuracy only");
  switch (settings.accuracy) {
    case GRAZE_EXACT:
      return Accuracy::exact();
    case GRAZE_WITHIN:
      return Accuracy::within(settings.tolerance);
    case GRAZE_PAPER:
      return Accuracy::paper(std::vector<double>(numbers.begin(), numbers.end()));
    default:
      throw BadArgument("accuracy is " + std::to_string(settings.accuracy) + ", which is no enumerator");
  }
}

/// Points at the numbers, which have to stay.
template <typename Struct>
void point_at(const std::vector<double>& epsilon, Struct& made) {
  made.epsilon_count = epsilon.size();
  made.epsilon = epsilon.empty() ? nullptr : epsilon.data();
}

template <typename Struct>
void accuracy_to_c(const Accuracy& accuracy, Struct& made) {
  made.accuracy = static_cast<std::uint8_t>(accuracy.mode());
  made.tolerance = accuracy.tolerance();
  point_at(accuracy.epsilon(), made);
}

std::vector<std::uint8_t> groups_from_c(const std::uint8_t* groups, std::size_t count, const char* name) {
  const auto numbers = array(groups, count, name);
  return {numbers.begin(), numbers.end()};
}

std::chrono::microseconds time_from_c(std::uint64_t microseconds) {
  constexpr auto longest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return std::chrono::microseconds(static_cast<std::int64_t>(std::min(microseconds, longest)));
}

}  // namespace

// A member that is added to a struct of C++ stops the build here until the C struct has it as well.
static_assert(
    are_all_fields<
        SceneSettings, &SceneSettings::contact_distance, &SceneSettings::range, &SceneSettings::detail,
        &SceneSettings::accuracy, &SceneSettings::threads, &SceneSettings::arena, &SceneSettings::time_budget,
        &SceneSettings::work_budget, &SceneSettings::max_contacts, &SceneSettings::max_contacts_per_pair,
        &SceneSettings::region_distances, &SceneSettings::ways_out, &SceneSettings::carrying,
        &SceneSettings::carrying_band, &SceneSettings::sweep_tolerance, &SceneSettings::swept_gap>());
static_assert(
    are_all_fields<ObjectSettings, &ObjectSettings::name, &ObjectSettings::motion, &ObjectSettings::layer,
                   &ObjectSettings::collides_with, &ObjectSettings::group, &ObjectSettings::margin,
                   &ObjectSettings::kind, &ObjectSettings::user_data, &ObjectSettings::solid,
                   &ObjectSettings::face_groups, &ObjectSettings::hidden_groups, &ObjectSettings::self,
                   &ObjectSettings::self_rings, &ObjectSettings::self_at_rest, &ObjectSettings::swept,
                   &ObjectSettings::queries, &ObjectSettings::patch_radius, &ObjectSettings::patch_faces>());
static_assert(are_all_fields<PairRule, &PairRule::contact_distance, &PairRule::range, &PairRule::epsilon>());
static_assert(are_all_fields<SceneCapacity, &SceneCapacity::objects, &SceneCapacity::calls_per_step,
                             &SceneCapacity::near_pairs, &SceneCapacity::contacts, &SceneCapacity::reports,
                             &SceneCapacity::impacts>());

static_assert(
    has_members<QuerySettings, &QuerySettings::contact_distance, &QuerySettings::range,
                &QuerySettings::detail, &QuerySettings::accuracy, &QuerySettings::a_is_solid,
                &QuerySettings::b_is_solid, &QuerySettings::max_contacts, &QuerySettings::ways_out>());
static_assert(has_members<RecorderSettings, &RecorderSettings::keyframe_interval,
                          &RecorderSettings::waiting_frames, &RecorderSettings::when_behind>());
static_assert(has_members<RingSettings, &RingSettings::byte_budget, &RingSettings::frames,
                          &RingSettings::on_diagnostic>());

void check_struct_size(std::size_t struct_size, const char* name) {
  if (struct_size < sizeof(std::size_t) || struct_size > most_struct_bytes)
    throw BadArgument(std::string(name) + ": a size of " + std::to_string(struct_size) +
                      " bytes; fill it with its init function first");
}

graze_scene_settings to_c(const SceneSettings& settings) {
  graze_scene_settings made{};
  made.struct_size = sizeof made;
  made.contact_distance = settings.contact_distance;
  made.range = settings.range;
  made.detail = static_cast<std::uint8_t>(settings.detail);
  accuracy_to_c(settings.accuracy, made);
  made.arena = static_cast<std::uint8_t>(settings.arena);
  made.ways_out = settings.ways_out;
  made.has_carrying_band = settings.carrying_band.has_value();
  made.threads = settings.threads;
  made.time_budget =
      settings.time_budget ? static_cast<std::uint64_t>(settings.time_budget->count()) : GRAZE_NO_LIMIT;
  made.work_budget = limit_to_c(settings.work_budget);
  made.max_contacts = limit_to_c(settings.max_contacts);
  made.max_contacts_per_pair = limit_to_c(settings.max_contacts_per_pair);
  made.region_distances = settings.region_distances;
  made.carrying = settings.carrying;
  made.carrying_band = settings.carrying_band.value_or(0);
  made.sweep_tolerance = settings.sweep_tolerance;
  made.swept_gap = settings.swept_gap;
  return made;
}

SceneSettings from_c(const graze_scene_settings& settings) {
  SceneSettings made;
  made.contact_distance = settings.contact_distance;
  made.range = settings.range;
  made.detail = static_cast<ContactDetail>(settings.detail);
  made.accuracy = accuracy_from_c(settings);
  made.threads = settings.threads;
  made.arena = static_cast<ArenaPolicy>(settings.arena);
  if (settings.time_budget != GRAZE_NO_LIMIT) made.time_budget = time_from_c(settings.time_budget);
  made.work_budget = limit_from_c<std::uint64_t>(settings.work_budget);
  made.max_contacts = limit_from_c<std::size_t>(settings.max_contacts);
  made.max_contacts_per_pair = limit_from_c<std::size_t>(settings.max_contacts_per_pair);
  made.region_distances = settings.region_distances;
  made.ways_out = settings.ways_out;
  made.carrying = settings.carrying;
  if (settings.has_carrying_band) made.carrying_band = settings.carrying_band;
  made.sweep_tolerance = settings.sweep_tolerance;
  made.swept_gap = settings.swept_gap;
  return made;
}

graze_object_settings to_c(const ObjectSettings& settings) {
  graze_object_settings made{};
  made.struct_size = sizeof made;
  made.name = settings.name.c_str();
  made.motion = static_cast<std::uint8_t>(settings.motion);
  made.solid = settings.solid;
  made.self = settings.self;
  made.self_at_rest = settings.self_at_rest;
  made.swept = settings.swept;
  made.queries = settings.queries;
  made.layer = settings.layer;
  made.collides_with = settings.collides_with;
  made.kind = settings.kind;
  made.self_rings = settings.self_rings;
  made.group = settings.group;
  made.margin = settings.margin;
  made.user_data = settings.user_data;
  made.face_group_count = settings.face_groups.size();
  made.face_groups = settings.face_groups.data();
  made.hidden_group_count = settings.hidden_groups.size();
  made.hidden_groups = settings.hidden_groups.data();
  made.patch_radius = settings.patch_radius;
  made.patch_faces = settings.patch_faces;
  return made;
}

ObjectSettings from_c(const graze_object_settings& settings) {
  ObjectSettings made;
  if (settings.name != nullptr) made.name = settings.name;
  made.motion = static_cast<Motion>(settings.motion);
  made.layer = settings.layer;
  made.collides_with = settings.collides_with;
  made.group = settings.group;
  made.margin = settings.margin;
  made.kind = settings.kind;
  made.user_data = settings.user_data;
  made.solid = settings.solid;
  made.face_groups = groups_from_c(settings.face_groups, settings.face_group_count, "face_groups");
  made.hidden_groups = groups_from_c(settings.hidden_groups, settings.hidden_group_count, "hidden_groups");
  made.self = settings.self;
  made.self_rings = settings.self_rings;
  made.self_at_rest = settings.self_at_rest;
  made.swept = settings.swept;
  made.queries = settings.queries;
  made.patch_radius = settings.patch_radius;
  made.patch_faces = settings.patch_faces;
  return made;
}

graze_pair_rule to_c(const PairRule& rule) {
  graze_pair_rule made{};
  made.struct_size = sizeof made;
  made.has_contact_distance = rule.contact_distance.has_value();
  made.has_range = rule.range.has_value();
  made.contact_distance = rule.contact_distance.value_or(0);
  made.range = rule.range.value_or(0);
  point_at(rule.epsilon, made);
  return made;
}

PairRule from_c(const graze_pair_rule& rule) {
  PairRule made;
  if (rule.has_contact_distance) made.contact_distance = rule.contact_distance;
  if (rule.has_range) made.range = rule.range;
  const auto epsilon = array(rule.epsilon, rule.epsilon_count, "epsilon");
  made.epsilon.assign(epsilon.begin(), epsilon.end());
  return made;
}

graze_scene_capacity to_c(const SceneCapacity& capacity) {
  return {sizeof(graze_scene_capacity),
          capacity.objects,
          capacity.calls_per_step,
          capacity.near_pairs,
          capacity.contacts,
          capacity.reports,
          capacity.impacts};
}

SceneCapacity from_c(const graze_scene_capacity& capacity) {
  return {.objects = capacity.objects,
          .calls_per_step = capacity.calls_per_step,
          .near_pairs = capacity.near_pairs,
          .contacts = capacity.contacts,
          .reports = capacity.reports,
          .impacts = capacity.impacts};
}

graze_query_settings to_c(const QuerySettings& settings) {
  graze_query_settings made{};
  made.struct_size = sizeof made;
  made.contact_distance = settings.contact_distance;
  made.range = settings.range;
  made.detail = static_cast<std::uint8_t>(settings.detail);
  accuracy_to_c(settings.accuracy, made);
  made.a_is_solid = settings.a_is_solid;
  made.b_is_solid = settings.b_is_solid;
  made.ways_out = settings.ways_out;
  made.max_contacts = limit_to_c(settings.max_contacts);
  return made;
}

QuerySettings from_c(const graze_query_settings& settings) {
  QuerySettings made;
  made.contact_distance = settings.contact_distance;
  made.range = settings.range;
  made.detail = static_cast<ContactDetail>(settings.detail);
  made.accuracy = accuracy_from_c(settings);
  made.a_is_solid = settings.a_is_solid;
  made.b_is_solid = settings.b_is_solid;
  made.max_contacts = limit_from_c<std::size_t>(settings.max_contacts);
  made.ways_out = settings.ways_out;
  return made;
}

graze_recorder_settings default_recorder_settings() {
  const RecorderSettings recorder;
  const RingSettings ring;
  return {sizeof(graze_recorder_settings),
          recorder.keyframe_interval,
          recorder.waiting_frames,
          static_cast<std::uint8_t>(recorder.when_behind),
          ring.byte_budget,
          limit_to_c(ring.frames),
          nullptr};
}

RecorderSettings recorder_settings_from_c(const graze_recorder_settings& settings) {
  return {.keyframe_interval = settings.keyframe_interval,
          .waiting_frames = settings.waiting_frames,
          .when_behind = static_cast<WhenBehind>(settings.when_behind)};
}

RingSettings ring_settings_from_c(const graze_recorder_settings& settings) {
  RingSettings made;
  made.byte_budget = settings.byte_budget;
  made.frames = limit_from_c<std::uint64_t>(settings.frames);
  if (settings.on_diagnostic != nullptr) made.on_diagnostic = settings.on_diagnostic;
  return made;
}

}  // namespace graze::c

using graze::c::guarded;

namespace {

/// Fills a caller's struct with the defaults of Settings. These stay, since the struct points into them.
template <typename Settings, typename Struct>
graze_status init(Struct* room, std::size_t struct_size, const char* name) {
  return guarded([&] {
    static const Settings defaults;
    graze::c::fill(room, struct_size, graze::c::to_c(defaults), name);
  });
}

}  // namespace

extern "C" {

graze_status graze_scene_settings_init(graze_scene_settings* settings, size_t struct_size) {
  return init<graze::SceneSettings>(settings, struct_size, "settings");
}

graze_status graze_object_settings_init(graze_object_settings* settings, size_t struct_size) {
  return init<graze::ObjectSettings>(settings, struct_size, "settings");
}

graze_status graze_pair_rule_init(graze_pair_rule* rule, size_t struct_size) {
  return init<graze::PairRule>(rule, struct_size, "rule");
}

graze_status graze_scene_capacity_init(graze_scene_capacity* capacity, size_t struct_size) {
  return init<graze::SceneCapacity>(capacity, struct_size, "capacity");
}

graze_status graze_query_settings_init(graze_query_settings* settings, size_t struct_size) {
  return init<graze::QuerySettings>(settings, struct_size, "settings");
}

graze_status graze_recorder_settings_init(graze_recorder_settings* settings, size_t struct_size) {
  return guarded(
      [&] { graze::c::fill(settings, struct_size, graze::c::default_recorder_settings(), "settings"); });
}

}  // extern "C"
