#include <algorithm>
#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/scene_file.hpp>
#include <graze/scene_enumerators.hpp>
#include <graze/settings_fields.hpp>
#include <limits>
#include <set>

#include "scene/scene_placement.hpp"
#include "text/json_path.hpp"
#include "text/out_of_memory.hpp"

namespace graze::io {
namespace {

constexpr std::uint32_t any_number = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t largest_kind = 255;
constexpr std::uint32_t largest_face_group = 255;

/// An enumerator by its name. `expected` says what stands there, such as "a motion".
template <NamedEnumeration Enum>
Enum read_enumerator(const JsonPath& json, std::string_view expected) {
  const auto enumerator = enumerator_named<Enum>(json.text());
  if (!enumerator) json.fail(expected, "write " + listed_names<Enum>());
  return *enumerator;
}

std::vector<double> read_epsilon(const JsonPath& json) {
  std::vector<double> epsilon;
  for (std::size_t i = 0; i < json.array_size("write [e1, e2, e3]"); ++i)
    epsilon.push_back(json.item(i).number_not_negative());
  return epsilon;
}

Accuracy read_accuracy(const JsonPath& json) {
  constexpr std::string_view remedy = R"(write "exact", {"within": 0.001} or {"paper": [24, 14, 8]})";
  if (json.value() == "exact") return Accuracy::exact();
  if (!json.value().is_object() || json.value().size() != 1) json.fail("an accuracy", remedy);
  json.expect_keys({"within", "paper"});
  if (const auto within = json.find("within")) return Accuracy::within(within->number_not_negative());
  return Accuracy::paper(read_epsilon(*json.find("paper")));
}

/// A distance that may also be the word "infinity".
double read_range(const JsonPath& json) {
  if (json.value() == "infinity") return std::numeric_limits<double>::infinity();
  return json.number_not_negative();
}

NumberOrName read_number_or_name(const JsonPath& json) {
  if (json.value().is_string()) return json.text();
  if (json.value().is_number_unsigned()) return json.whole_number(0, any_number);
  json.fail("a number from 0 or a name", "write one of the names or numbers that `graze inspect` lists");
}

UpAxis read_up(const JsonPath& json) {
  const std::string word = json.value().is_string() ? json.text() : "";
  if (const auto axis = enumerator_named<UpAxis>(word)) return *axis;
  json.fail("an axis that points up", "write x, y or z");
}

/// Metres in one unit.
double read_unit(const JsonPath& json) {
  constexpr std::array<std::pair<std::string_view, double>, 9> units{{{"m", 1},
                                                                      {"dm", 0.1},
                                                                      {"cm", 0.01},
                                                                      {"mm", 0.001},
                                                                      {"um", 1e-6},
                                                                      {"km", 1000},
                                                                      {"inch", 0.0254},
                                                                      {"foot", 0.3048},
                                                                      {"yard", 0.9144}}};
  if (json.value().is_number()) return json.number_positive();
  const std::string word = json.value().is_string() ? json.text() : "";
  const auto* const unit = std::ranges::find(units, word, &std::pair<std::string_view, double>::first);
  if (unit == units.end())
    json.fail("a unit of length", "write m, dm, cm, mm, um, km, inch, foot, yard, or its metres as a number");
  return unit->second;
}

/// Reads an object's `up` and `unit`. The word "file" in place of a value asks for what the mesh file says.
void read_frame(const JsonPath& json, ObjectDescription& object) {
  if (const auto up = json.find("up")) {
    object.up_is_the_files = up->value() == "file";
    if (!object.up_is_the_files) object.up = read_up(*up);
  }
  if (const auto unit = json.find("unit")) {
    object.unit_is_the_files = unit->value() == "file";
    if (!object.unit_is_the_files) object.metres_per_unit = read_unit(*unit);
  }
}

std::uint8_t read_face_group(const JsonPath& json) {
  return static_cast<std::uint8_t>(json.whole_number(0, largest_face_group));
}

/// Refuses keys that do not go with the object's motion.
void check_motion(const ObjectDescription& object, const JsonPath& json) {
  const bool has_source = !object.positions.empty() || object.animation.has_value();
  if (!object.positions.empty() && object.animation)
    json.find("animation")->refuse("stands beside positions; keep one of the two");
  if (has_source && object.settings.motion != Motion::deformable)
    json.find("motion")->refuse(
        "positions and animation need a deformable object; write deformable, or leave them out");
  if (!object.poses.empty() && object.settings.motion != Motion::rigid)
    json.find("poses")->refuse(R"(poses need a rigid object; write "motion": "rigid", or leave them out)");
}

// One overload for each type of a field of ObjectSettings.

void read_field(const JsonPath& json, std::string& text) {
  text = json.text();
}
void read_field(const JsonPath& json, Motion& motion) {
  motion = read_enumerator<Motion>(json, "a motion");
}
void read_field(const JsonPath& json, std::uint32_t& number) {
  const bool is_kind = json.key() == field_name<ObjectSettings, &ObjectSettings::kind>();
  const bool are_rings = json.key() == field_name<ObjectSettings, &ObjectSettings::self_rings>();
  const bool are_faces = json.key() == field_name<ObjectSettings, &ObjectSettings::patch_faces>();
  number = json.whole_number(are_faces ? 1 : 0, is_kind     ? largest_kind
                                                : are_rings ? most_self_rings
                                                            : any_number);
}
void read_field(const JsonPath& json, std::uint64_t& number) {
  number = json.whole_number(0, any_number);
}
void read_field(const JsonPath& json, double& length) {
  length = json.number_not_negative();
}
void read_field(const JsonPath& json, bool& truth) {
  truth = json.truth();
}
void read_field(const JsonPath& json, std::vector<std::uint8_t>& groups) {
  const bool are_hidden = json.key() == field_name<ObjectSettings, &ObjectSettings::hidden_groups>();
  const std::string_view remedy = are_hidden ? "write the groups that are hidden, such as [1, 2]"
                                             : "write a number for each face, such as [0, 0, 1]";
  for (std::size_t i = 0; i < json.array_size(remedy); ++i) groups.push_back(read_face_group(json.item(i)));
}

/// Calls `visit` with each field of ObjectSettings that an entry may have. `user_data` is for programs.
template <typename Visit>
void for_each_described_field(const Visit& visit) {
  for_each_field<ObjectSettings, &ObjectSettings::user_data>(visit);
}

void expect_object_keys(const JsonPath& json) {
  std::vector<std::string_view> keys;
  for_each_described_field([&](const auto& field) { keys.push_back(field.name); });
  keys.insert(keys.begin() + 1,
              {"mesh", "node", "up", "unit", "positions", "animation", "transform", "poses"});
  json.expect_keys(keys);
}

ObjectDescription read_object(const JsonPath& json, const std::filesystem::path& folder) {
  expect_object_keys(json);
  ObjectDescription object;
  object.place = json.where();
  object.mesh = folder / json.require("mesh", "name the object's mesh file").text();
  if (const auto node = json.find("node")) object.node = read_number_or_name(*node);
  read_frame(json, object);
  if (const auto positions = json.find("positions")) object.positions = folder / positions->text();
  if (const auto animation = json.find("animation")) object.animation = read_number_or_name(*animation);
  if (const auto transform = json.find("transform")) object.transform = read_placement(*transform);
  if (const auto poses = json.find("poses")) object.poses = read_poses(*poses, object.transform);
  const bool has_source = !object.positions.empty() || object.animation.has_value();
  object.settings.motion = has_source ? Motion::deformable : Motion::rigid;
  for_each_described_field([&](const auto& field) {
    if (const auto value = json.find(field.name)) read_field(*value, object.settings.*field.member);
  });
  check_motion(object, json);
  return object;
}

RuleDescription read_rule(const JsonPath& json) {
  static_assert(are_all_fields<PairRule, &PairRule::contact_distance, &PairRule::range, &PairRule::epsilon>(),
                "each field of PairRule is a key here");
  json.expect_keys({"kinds", "contact_distance", "range", "epsilon"});
  RuleDescription rule;
  const JsonPath kinds = json.require("kinds", "name the two kinds it is for, such as [0, 3]");
  if (kinds.array_size("write [kind, kind]") != 2) kinds.fail("two kinds", "write [kind, kind]");
  for (std::size_t i = 0; i < 2; ++i) rule.kinds[i] = kinds.item(i).whole_number(0, largest_kind);
  if (const auto distance = json.find("contact_distance"))
    rule.contact_distance = distance->number_not_negative();
  if (const auto range = json.find("range")) rule.range = read_range(*range);
  if (const auto epsilon = json.find("epsilon")) rule.epsilon = read_epsilon(*epsilon);
  return rule;
}

IgnoreDescription read_ignore(const JsonPath& json) {
  constexpr std::string_view remedy = R"(write ["name", "name"] or ["name", group, "name", group])";
  const std::size_t size = json.array_size(remedy);
  if (size == 2) return {{json.item(0).text(), json.item(1).text()}, std::nullopt, json.where()};
  if (size != 4) json.fail("two names", remedy);
  return {{json.item(0).text(), json.item(2).text()},
          std::array{read_face_group(json.item(1)), read_face_group(json.item(3))},
          json.where()};
}

// One overload for each type of a setting of scene files.

void read_setting(const JsonPath& json, double& length) {
  const bool may_be_infinite = json.key() == field_name<SceneSettings, &SceneSettings::range>();
  length = may_be_infinite ? read_range(json) : json.number_not_negative();
  const bool is_part_of_step = json.key() == field_name<SceneSettings, &SceneSettings::sweep_tolerance>();
  if (is_part_of_step && (length < 0x1p-52 || length > 1))
    json.fail("a part of a step", "write at least 2.3e-16 and at most 1");
}
void read_setting(const JsonPath& json, ContactDetail& detail) {
  detail = read_enumerator<ContactDetail>(json, "a contact detail");
}
void read_setting(const JsonPath& json, Accuracy& accuracy) {
  accuracy = read_accuracy(json);
}
void read_setting(const JsonPath& json, std::optional<std::size_t>& most) {
  most = json.whole_number(1, any_number);
}
void read_setting(const JsonPath& json, std::size_t& most) {
  most = json.whole_number(0, any_number);
}
void read_setting(const JsonPath& json, std::optional<double>& length) {
  length = json.number_not_negative();
}
void read_setting(const JsonPath& json, bool& truth) {
  truth = json.truth();
}

/// Calls `visit` with each setting that scene files have. Threads, the arena, budgets and region distances
/// belong to a run, and not to a scene: the command line says them.
template <typename Visit>
void for_each_setting_of_files(const Visit& visit) {
  for_each_field<SceneSettings, &SceneSettings::threads, &SceneSettings::arena, &SceneSettings::time_budget,
                 &SceneSettings::work_budget, &SceneSettings::region_distances>(visit);
}

void expect_scene_keys(const JsonPath& json) {
  std::vector<std::string_view> keys = {"graze"};
  for_each_setting_of_files([&](const auto& field) { keys.push_back(field.name); });
  keys.insert(keys.end(),
              {"frames", "frames_per_second", "up", "unit", "objects", "rules", "ignore", "outside_files"});
  json.expect_keys(keys);
}

void read_settings(const JsonPath& json, SceneSettings& settings) {
  for_each_setting_of_files([&](const auto& field) {
    if (const auto value = json.find(field.name)) read_setting(*value, settings.*field.member);
  });
}

void read_scene_objects(const JsonPath& json, const std::filesystem::path& folder, SceneDescription& scene) {
  constexpr std::string_view remedy = R"(write [{"mesh": "file.obj"}, ...])";
  if (json.array_size(remedy) == 0) json.fail("at least one object", remedy);
  std::set<std::string> names;
  for (std::size_t i = 0; i < json.value().size(); ++i) {
    scene.objects.push_back(read_object(json.item(i), folder));
    const std::string& name = scene.objects.back().settings.name;
    if (!name.empty() && !names.insert(name).second)
      json.item(i).find("name")->refuse("another object is called \"" + name +
                                        "\" already; choose another name");
  }
}

}  // namespace

namespace {

SceneDescription read_scene(const std::filesystem::path& path) {
  const nlohmann::json document = parse_json_file(path);
  const JsonPath root(path.string(), document);
  expect_scene_keys(root);
  const JsonPath version = root.require("graze", R"(add "graze": 1, the version of the format)");
  if (version.value() != 1) version.fail("version 1", "this program reads version 1 of the format");

  SceneDescription scene;
  scene.file = path.string();
  read_settings(root, scene.settings);
  if (const auto frames = root.find("frames")) scene.frames = frames->whole_number(1, any_number);
  if (const auto rate = root.find("frames_per_second")) scene.frames_per_second = rate->number_positive();
  if (const auto up = root.find("up")) scene.up = read_up(*up);
  if (const auto unit = root.find("unit")) scene.metres_per_unit = read_unit(*unit);
  if (const auto outside = root.find("outside_files")) scene.outside_files = outside->truth();
  read_scene_objects(root.require("objects", "list the objects of the scene"), path.parent_path(), scene);
  if (const auto rules = root.find("rules"))
    for (std::size_t i = 0; i < rules->array_size(R"(write [{"kinds": [0, 1], ...}])"); ++i)
      scene.rules.push_back(read_rule(rules->item(i)));
  if (const auto ignore = root.find("ignore"))
    for (std::size_t i = 0; i < ignore->array_size(R"(write [["name", "name"], ...])"); ++i)
      scene.ignore.push_back(read_ignore(ignore->item(i)));
  return scene;
}

}  // namespace

SceneDescription read_scene_file(const std::filesystem::path& path) {
  return with_memory_for(path, [&] { return read_scene(path); });
}

SceneDescription scene_of_meshes(const std::vector<std::filesystem::path>& files) {
  SceneDescription scene;
  scene.file = "command line";
  for (const std::filesystem::path& file : files) {
    ObjectDescription object;
    object.mesh = file;
    object.settings.motion = Motion::rigid;
    object.animate_where_possible = true;
    object.place = file.string();
    scene.objects.push_back(std::move(object));
  }
  return scene;
}

}  // namespace graze::io
