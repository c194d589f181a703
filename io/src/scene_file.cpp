#include <algorithm>
#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/scene_file.hpp>
#include <limits>
#include <set>

#include "json_place.hpp"
#include "scene_placement.hpp"

namespace graze::io {
namespace {

constexpr std::uint32_t any_number = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t largest_kind = 255;

constexpr std::array<std::pair<std::string_view, ContactDetail>, 5> details{{
    {"none", ContactDetail::none},
    {"closest", ContactDetail::closest},
    {"regions", ContactDetail::regions},
    {"vertices", ContactDetail::vertices},
    {"features", ContactDetail::features},
}};

ContactDetail read_detail(const JsonPlace& place) {
  const auto detail = contact_detail_from(place.text());
  if (!detail) place.fail("a contact detail", "write none, closest, regions, vertices or features");
  return *detail;
}

std::vector<double> read_epsilon(const JsonPlace& place) {
  std::vector<double> epsilon;
  for (std::size_t i = 0; i < place.array_size("write [e1, e2, e3]"); ++i)
    epsilon.push_back(place.item(i).number_not_negative());
  return epsilon;
}

Accuracy read_accuracy(const JsonPlace& place) {
  constexpr std::string_view remedy = R"(write "exact", {"within": 0.001} or {"paper": [24, 14, 8]})";
  if (place.value() == "exact") return Accuracy::exact();
  if (!place.value().is_object() || place.value().size() != 1) place.fail("an accuracy", remedy);
  place.expect_keys({"within", "paper"});
  if (const auto within = place.find("within")) return Accuracy::within(within->number_not_negative());
  return Accuracy::paper(read_epsilon(*place.find("paper")));
}

/// A distance that may also be the word "infinity".
double read_range(const JsonPlace& place) {
  if (place.value() == "infinity") return std::numeric_limits<double>::infinity();
  return place.number_not_negative();
}

Motion read_motion(const JsonPlace& place) {
  const std::string word = place.text();
  if (word == "deformable") return Motion::deformable;
  if (word == "rigid") return Motion::rigid;
  if (word == "fixed") return Motion::fixed;
  place.fail("a motion", "write deformable, rigid or fixed");
}

NumberOrName read_number_or_name(const JsonPlace& place) {
  if (place.value().is_string()) return place.text();
  if (place.value().is_number_unsigned()) return place.whole_number(0, any_number);
  place.fail("a number from 0 or a name", "write one of the names or numbers that `graze inspect` lists");
}

UpAxis read_up(const JsonPlace& place) {
  const std::string word = place.value().is_string() ? place.text() : "";
  if (word == "x") return UpAxis::x;
  if (word == "y") return UpAxis::y;
  if (word == "z") return UpAxis::z;
  place.fail("an axis that points up", "write x, y or z");
}

/// Metres in one unit.
double read_unit(const JsonPlace& place) {
  constexpr std::array<std::pair<std::string_view, double>, 9> units{{{"m", 1},
                                                                      {"dm", 0.1},
                                                                      {"cm", 0.01},
                                                                      {"mm", 0.001},
                                                                      {"um", 1e-6},
                                                                      {"km", 1000},
                                                                      {"inch", 0.0254},
                                                                      {"foot", 0.3048},
                                                                      {"yard", 0.9144}}};
  if (place.value().is_number()) return place.number_positive();
  const std::string word = place.value().is_string() ? place.text() : "";
  const auto* const unit = std::ranges::find(units, word, &std::pair<std::string_view, double>::first);
  if (unit == units.end())
    place.fail("a unit of length",
               "write m, dm, cm, mm, um, km, inch, foot, yard, or its metres as a number");
  return unit->second;
}

/// Reads an object's `up` and `unit`. The word "file" in place of a value asks for what the mesh file says.
void read_frame(const JsonPlace& place, ObjectDescription& object) {
  if (const auto up = place.find("up")) {
    object.up_is_the_files = up->value() == "file";
    if (!object.up_is_the_files) object.up = read_up(*up);
  }
  if (const auto unit = place.find("unit")) {
    object.unit_is_the_files = unit->value() == "file";
    if (!object.unit_is_the_files) object.metres_per_unit = read_unit(*unit);
  }
}

/// What may stand beside which motion.
void check_motion(const ObjectDescription& object, const JsonPlace& place) {
  const bool has_source = !object.positions.empty() || object.animation.has_value();
  if (!object.positions.empty() && object.animation)
    place.find("animation")->refuse("stands beside positions; keep one of the two");
  if (has_source && object.motion != Motion::deformable)
    place.find("motion")->refuse(
        "positions and animation need a deformable object; write deformable, or leave them out");
  if (!object.poses.empty() && object.motion != Motion::rigid)
    place.find("poses")->refuse(R"(poses need a rigid object; write "motion": "rigid", or leave them out)");
}

ObjectDescription read_object(const JsonPlace& place, const std::filesystem::path& folder) {
  place.expect_keys({"name", "mesh", "node", "up", "unit", "motion", "positions", "animation", "transform",
                     "poses", "layer", "collides_with", "group", "margin", "kind"});
  ObjectDescription object;
  object.place = place.where();
  object.mesh = folder / place.require("mesh", "name the object's mesh file").text();
  if (const auto name = place.find("name")) object.name = name->text();
  if (const auto node = place.find("node")) object.node = read_number_or_name(*node);
  read_frame(place, object);
  if (const auto positions = place.find("positions")) object.positions = folder / positions->text();
  if (const auto animation = place.find("animation")) object.animation = read_number_or_name(*animation);
  if (const auto transform = place.find("transform")) object.transform = read_placement(*transform);
  if (const auto poses = place.find("poses")) object.poses = read_poses(*poses, object.transform);
  if (const auto layer = place.find("layer")) object.layer = layer->whole_number(0, any_number);
  if (const auto mask = place.find("collides_with")) object.collides_with = mask->whole_number(0, any_number);
  if (const auto group = place.find("group")) object.group = group->whole_number(0, any_number);
  if (const auto margin = place.find("margin")) object.margin = margin->number_not_negative();
  if (const auto kind = place.find("kind")) object.kind = kind->whole_number(0, largest_kind);
  if (!object.positions.empty() || object.animation) object.motion = Motion::deformable;
  if (const auto motion = place.find("motion")) object.motion = read_motion(*motion);
  check_motion(object, place);
  return object;
}

RuleDescription read_rule(const JsonPlace& place) {
  place.expect_keys({"kinds", "contact_distance", "range", "epsilon"});
  RuleDescription rule;
  const JsonPlace kinds = place.require("kinds", "name the two kinds it is for, such as [0, 3]");
  if (kinds.array_size("write [kind, kind]") != 2) kinds.fail("two kinds", "write [kind, kind]");
  for (std::size_t i = 0; i < 2; ++i) rule.kinds[i] = kinds.item(i).whole_number(0, largest_kind);
  if (const auto distance = place.find("contact_distance"))
    rule.contact_distance = distance->number_not_negative();
  if (const auto range = place.find("range")) rule.range = read_range(*range);
  if (const auto epsilon = place.find("epsilon")) rule.epsilon = read_epsilon(*epsilon);
  return rule;
}

IgnoreDescription read_ignore(const JsonPlace& place) {
  if (place.array_size(R"(write ["name", "name"])") != 2)
    place.fail("two names", R"(write ["name", "name"])");
  return {{place.item(0).text(), place.item(1).text()}, place.where()};
}

void read_settings(const JsonPlace& place, SceneSettings& settings) {
  if (const auto distance = place.find("contact_distance"))
    settings.contact_distance = distance->number_not_negative();
  if (const auto range = place.find("range")) settings.range = read_range(*range);
  if (const auto detail = place.find("detail")) settings.detail = read_detail(*detail);
  if (const auto accuracy = place.find("accuracy")) settings.accuracy = read_accuracy(*accuracy);
  if (const auto most = place.find("max_contacts")) settings.max_contacts = most->whole_number(1, any_number);
  if (const auto most = place.find("max_contacts_per_pair"))
    settings.max_contacts_per_pair = most->whole_number(1, any_number);
}

void read_scene_objects(const JsonPlace& place, const std::filesystem::path& folder,
                        SceneDescription& scene) {
  constexpr std::string_view remedy = R"(write [{"mesh": "file.obj"}, ...])";
  if (place.array_size(remedy) == 0) place.fail("at least one object", remedy);
  std::set<std::string> names;
  for (std::size_t i = 0; i < place.value().size(); ++i) {
    scene.objects.push_back(read_object(place.item(i), folder));
    const std::string& name = scene.objects.back().name;
    if (!name.empty() && !names.insert(name).second)
      place.item(i).find("name")->refuse("another object is called \"" + name +
                                         "\" already; choose another name");
  }
}

}  // namespace

SceneDescription read_scene_file(const std::filesystem::path& path) {
  const nlohmann::json document = parse_json_file(path);
  const JsonPlace root(path.string(), document);
  root.expect_keys({"graze", "contact_distance", "range", "detail", "accuracy", "max_contacts",
                    "max_contacts_per_pair", "frames", "frames_per_second", "up", "unit", "objects", "rules",
                    "ignore"});
  const JsonPlace version = root.require("graze", R"(add "graze": 1, the version of the format)");
  if (version.value() != 1) version.fail("version 1", "this program reads version 1 of the format");

  SceneDescription scene;
  scene.file = path.string();
  read_settings(root, scene.settings);
  if (const auto frames = root.find("frames")) scene.frames = frames->whole_number(1, any_number);
  if (const auto rate = root.find("frames_per_second")) scene.frames_per_second = rate->number_positive();
  if (const auto up = root.find("up")) scene.up = read_up(*up);
  if (const auto unit = root.find("unit")) scene.metres_per_unit = read_unit(*unit);
  read_scene_objects(root.require("objects", "list the objects of the scene"), path.parent_path(), scene);
  if (const auto rules = root.find("rules"))
    for (std::size_t i = 0; i < rules->array_size(R"(write [{"kinds": [0, 1], ...}])"); ++i)
      scene.rules.push_back(read_rule(rules->item(i)));
  if (const auto ignore = root.find("ignore"))
    for (std::size_t i = 0; i < ignore->array_size(R"(write [["name", "name"], ...])"); ++i)
      scene.ignore.push_back(read_ignore(ignore->item(i)));
  return scene;
}

SceneDescription scene_of_meshes(const std::vector<std::filesystem::path>& files) {
  SceneDescription scene;
  scene.file = "command line";
  for (const std::filesystem::path& file : files) {
    ObjectDescription object;
    object.mesh = file;
    object.animate_where_possible = true;
    object.place = file.string();
    scene.objects.push_back(std::move(object));
  }
  return scene;
}

std::optional<ContactDetail> contact_detail_from(std::string_view word) {
  const auto* const found =
      std::ranges::find(details, word, &std::pair<std::string_view, ContactDetail>::first);
  if (found == details.end()) return std::nullopt;
  return found->second;
}

std::string_view to_string(ContactDetail detail) {
  return std::ranges::find(details, detail, &std::pair<std::string_view, ContactDetail>::second)->first;
}

}  // namespace graze::io
