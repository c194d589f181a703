#include <graze/enumerators.hpp>
#include <graze/io/error.hpp>
#include <graze/io/scene_file.hpp>
#include <limits>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using graze::io::InputError;
using graze::io::read_scene_file;
using graze::io::rotation_from_degrees;
using graze::io::SceneDescription;
using graze::tests::TemporaryFolder;

/// A scene whose one object has `object` beside its mesh, and whose document has `document` beside its
/// objects.
std::string scene_with(const std::string& document, const std::string& object) {
  return R"({"graze": 1)" + (document.empty() ? "" : ", " + document) + R"(, "objects": [{"mesh": "a.obj")" +
         (object.empty() ? "" : ", " + object) + "}]}";
}

std::string error_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.write("scene.json", text);
  try {
    read_scene_file(path);
  } catch (const InputError& error) {
    const std::string message = error.what();
    REQUIRE(message.starts_with(path.string() + ": "));
    REQUIRE(message.find('\n') == std::string::npos);
    return message.substr(path.string().size() + 2);
  }
  return "accepted";
}

struct BadScene {
  std::string text;
  std::string message_start;  ///< after the file's name
};

const std::vector<BadScene> bad_scenes = {
    {"", "line 1, column 1: not valid JSON"},
    {"{\n  \"graze\": 1,\n  \"objects\": [,]\n}", "line 3, column 15: not valid JSON"},
    {"{\n  \"graze\": 1,\n  \"objects\": [{\"mesh\": \"a.obj\"},\n  ]\n}",
     "line 3, column 32: a trailing comma stands before a closing bracket"},
    {"{\n  \"graze\": 1,\n}", "line 2, column 13: a trailing comma stands before a closing bracket"},
    {"{\n  // the version\n  \"graze\": 1}", "line 2, column 3: a comment stands here"},
    {"{\n  \"graze\": 1, /* the\n version */ \"objects\": []}", "line 2, column 15: a comment stands here"},
    {"{\n  \"graze\": 1 // the version\n}", "line 2, column 14: a comment stands here"},
    {"{\n  \"graze\": 1,\n  # objects\n}", "line 3, column 3: a comment stands here"},
    {"// a scene\n{\"graze\": 1}", "line 1, column 1: a comment stands here"},
    {"{\"graze\": 1} // a scene\n", "line 1, column 14: a comment stands here"},
    {R"({"graze": 1, "objects": [{"mesh": "a.obj"}], "graze": 1})", R"(key "graze" stands twice)"},
    {R"({"graze": 1, "range": 1e999, "objects": [{"mesh": "a.obj"}]})", "holds a number too large"},
    {"[]", "expected an object, got []"},
    {R"({"objects": [{"mesh": "a.obj"}]})", R"(key "graze" is missing; add "graze": 1)"},
    {R"({"graze": 2, "objects": [{"mesh": "a.obj"}]})", "graze: expected version 1, got 2;"},
    {R"({"graze": 1})", R"(key "objects" is missing)"},
    {R"({"graze": 1, "objects": []})", "objects: expected at least one object, got []"},
    {R"({"graze": 1, "objects": {}})", "objects: expected an array, got {}"},
    {R"({"graze": 1, "objects": [7]})", "objects[0]: expected an object, got 7"},
    {R"({"graze": 1, "objects": [{"name": "a"}]})", R"(objects[0]: key "mesh" is missing)"},
    {scene_with(R"("contact_distanse": 1)", ""), "contact_distanse: unknown key; known here are graze, "},
    {scene_with(R"("contact_distance": -1)", ""),
     "contact_distance: expected a number that is not negative, got -1"},
    {scene_with(R"("contact_distance": "infinity")", ""),
     "contact_distance: expected a number that is not negative"},
    {scene_with(R"("range": "far")", ""), R"(range: expected a number that is not negative, got "far")"},
    {scene_with(R"("detail": "all")", ""),
     R"(detail: expected a contact detail, got "all"; write none, closest)"},
    {scene_with(R"("detail": 3)", ""), "detail: expected a text, got 3"},
    {scene_with(R"("accuracy": "rough")", ""), R"(accuracy: expected an accuracy, got "rough")"},
    {scene_with(R"("accuracy": {})", ""), "accuracy: expected an accuracy, got {}"},
    {scene_with(R"("accuracy": {"within": -1})", ""),
     "accuracy.within: expected a number that is not negative"},
    {scene_with(R"("accuracy": {"paper": [1, -2]})", ""),
     "accuracy.paper[1]: expected a number that is not neg"},
    {scene_with(R"("frames": 0)", ""), "frames: expected a whole number from 1 to 4294967295, got 0"},
    {scene_with(R"("frames": 1.5)", ""), "frames: expected a whole number from 1 to 4294967295, got 1.5"},
    {scene_with(R"("frames_per_second": 0)", ""), "frames_per_second: expected a number above 0, got 0"},
    {scene_with("", R"("colour": "red")"), "objects[0].colour: unknown key; known here are name, mesh, "},
    {scene_with("", R"("name": "")"), R"(objects[0].name: expected a text, got "")"},
    {scene_with("", R"("node": -1)"), "objects[0].node: expected a number from 0 or a name, got -1"},
    {scene_with("", R"("motion": "soft")"),
     R"(objects[0].motion: expected a motion, got "soft"; write deformable)"},
    {scene_with("", R"("solid": 1)"), R"(objects[0].solid: expected true or false, got 1)"},
    {scene_with("", R"("margin": "x")"),
     R"(objects[0].margin: expected a number that is not negative, got "x")"},
    {scene_with("", R"("kind": 256)"), "objects[0].kind: expected a whole number from 0 to 255, got 256"},
    {scene_with("", R"("layer": -1)"),
     "objects[0].layer: expected a whole number from 0 to 4294967295, got -1"},
    {scene_with("", R"("collides_with": 4294967296)"), "objects[0].collides_with: expected a whole number"},
    {scene_with("", R"("transform": {"translate": [1, 2]})"),
     "objects[0].transform.translate: expected three numbers"},
    {scene_with("", R"("transform": {"translate": [1, 2, "z"]})"),
     R"(objects[0].transform.translate[2]: expected a number, got "z")"},
    {scene_with(R"("max_contacts": 0)", ""), "max_contacts: expected a whole number from 1 to"},
    {scene_with(R"("max_contacts_per_pair": 1.5)", ""),
     "max_contacts_per_pair: expected a whole number from 1 to"},
    {scene_with(R"("ways_out": 1)", ""), "ways_out: expected true or false, got 1"},
    {scene_with(R"("carrying": -4)", ""), "carrying: expected a whole number from 0 to 4294967295, got -4"},
    {scene_with(R"("carrying_band": -1)", ""),
     "carrying_band: expected a number that is not negative, got -1"},
    {scene_with(R"("carrying_band": "infinity")", ""),
     "carrying_band: expected a number that is not negative"},
    {scene_with(R"("up": "w")", ""), R"(up: expected an axis that points up, got "w"; write x, y or z)"},
    {scene_with("", R"("unit": "furlong")"), R"(objects[0].unit: expected a unit of length, got "furlong")"},
    {scene_with("", R"("unit": 0)"), "objects[0].unit: expected a number above 0, got 0"},
    {scene_with("", R"("up": 2)"), "objects[0].up: expected an axis that points up, got 2"},
    {scene_with("", R"("transform": {"scale": [1, 0, 1]})"),
     "objects[0].transform.scale: expected a number other than 0, or three of them, got [1,0,1]"},
    {scene_with("", R"("transform": {"scale": [1, 2]})"),
     "objects[0].transform.scale: expected a number other"},
    {scene_with("", R"("transform": {"rotate_quaternion": [0, 0, 0, 2]})"),
     "objects[0].transform.rotate_quaternion: expected a quaternion of length 1, got [0,0,0,2]"},
    {scene_with("", R"("transform": {"rotate_quaternion": [0, 0, 1]})"),
     "objects[0].transform.rotate_quaternion: expected 4 numbers"},
    {scene_with("", R"("transform": {"rotate_quaternion": [0, 0, 0, 1], "rotate_degrees": [0, 0, 1]})"),
     "objects[0].transform.rotate_quaternion: stands beside rotate_degrees"},
    {scene_with("", R"("transform": {"matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]})"),
     "objects[0].transform.matrix: expected a 4 × 4 matrix"},
    {scene_with("", R"("transform": {"matrix": [[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]]})"),
     "objects[0].transform.matrix: it flattens space"},
    {scene_with("", R"("transform": {"matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[5,5,5,1]]})"),
     "objects[0].transform.matrix: its last row is not 0 0 0 1"},
    {scene_with("", R"("transform": {"matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "scale": 2})"),
     "objects[0].transform.matrix: says all of where it stands"},
    {scene_with("", R"("poses": [{"frame": 0, "matrix": [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]}])"),
     "objects[0].poses[0].matrix: it scales, shears or mirrors"},
    {scene_with("", R"("transform": {"scale": 0})"),
     "objects[0].transform.scale: expected a number other than 0, or three of them, got 0"},
    {scene_with("", R"("transform": {"rotate": [0, 0, 0]})"), "objects[0].transform.rotate: unknown key"},
    {scene_with("", R"("poses": [])"), "objects[0].poses: expected at least one pose"},
    {scene_with("", R"("poses": [{"translate": [0, 0, 0]}])"),
     R"(objects[0].poses[0]: key "frame" is missing)"},
    {scene_with("", R"("poses": [{"frame": 3}, {"frame": 3}])"),
     "objects[0].poses[1].frame: expected a frame after 3"},
    {scene_with("", R"("poses": [{"frame": 3, "scale": 2}])"), "objects[0].poses[0].scale: unknown key"},
    {scene_with("", R"("motion": "fixed", "poses": [{"frame": 0}])"),
     "objects[0].poses: poses need a rigid object"},
    {scene_with("", R"("motion": "rigid", "positions": "a_##.obj")"),
     "objects[0].motion: positions and animation need"},
    {scene_with("", R"("positions": "a.pc2", "poses": [{"frame": 0}])"),
     "objects[0].poses: poses need a rigid object"},
    {scene_with("", R"("positions": "a.pc2", "animation": 0)"),
     "objects[0].animation: stands beside positions"},
    {R"({"graze": 1, "objects": [{"mesh": "a.obj", "name": "x"}, {"mesh": "b.obj", "name": "x"}]})",
     R"(objects[1].name: another object is called "x" already)"},
    {scene_with(R"("rules": {})", ""), "rules: expected an array, got {}"},
    {scene_with(R"("rules": [{}])", ""), R"(rules[0]: key "kinds" is missing)"},
    {scene_with(R"("rules": [{"kinds": [0]}])", ""), "rules[0].kinds: expected two kinds, got [0]"},
    {scene_with(R"("rules": [{"kinds": [0, 256]}])", ""),
     "rules[0].kinds[1]: expected a whole number from 0 to 255"},
    {scene_with(R"("rules": [{"kinds": [0, 1], "epsilon": 3}])", ""),
     "rules[0].epsilon: expected an array, got 3"},
    {scene_with(R"("ignore": ["a", "b"])", ""), R"(ignore[0]: expected an array, got "a")"},
    {scene_with(R"("ignore": [["a"]])", ""), R"(ignore[0]: expected two names, got ["a"])"},
    {scene_with(R"("ignore": [["a", 1, "b"]])", ""), R"(ignore[0]: expected two names, got ["a",1,"b"])"},
    {scene_with(R"("ignore": [["a", 1, "b", 256]])", ""),
     "ignore[0][3]: expected a whole number from 0 to 255"},
    {scene_with(R"("ignore": [["a", "b", 1, 2]])", ""), "ignore[0][2]: expected a text, got 1"},
    {scene_with("", R"("face_groups": 3)"), "objects[0].face_groups: expected an array, got 3"},
    {scene_with("", R"("face_groups": [0, -1])"),
     "objects[0].face_groups[1]: expected a whole number from 0 to 255"},
    {scene_with("", R"("hidden_groups": 3)"),
     "objects[0].hidden_groups: expected an array, got 3; write the groups that are hidden"},
    {scene_with("", R"("hidden_groups": [7, 256])"),
     "objects[0].hidden_groups[1]: expected a whole number from 0 to 255, got 256"},
    {scene_with("", R"("self": 1)"), "objects[0].self: expected true or false, got 1"},
    {scene_with("", R"("self_rings": 9)"),
     "objects[0].self_rings: expected a whole number from 0 to 8, got 9"},
    {scene_with("", R"("patch_faces": 0)"), "objects[0].patch_faces: expected a whole number from 1"},
    {scene_with(R"("swept_gap": -1)", ""), "swept_gap: expected a number that is not negative, got -1"},
    {scene_with(R"("sweep_tolerance": 0)", ""), "sweep_tolerance: expected a part of a step, got 0"},
    {scene_with(R"("sweep_tolerance": 1.5)", ""), "sweep_tolerance: expected a part of a step, got 1.5"},
};

}  // namespace

TEST_CASE("a scene file with a mistake is refused by file and place, in one line") {
  for (const BadScene& bad : bad_scenes) {
    const std::string message = error_of(bad.text);
    INFO(bad.text << "\n  gave   " << message << "\n  wanted " << bad.message_start);
    CHECK(message.starts_with(bad.message_start));
  }
}

TEST_CASE("a scene file that is not there is refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_scene_file(folder / "none.json"), InputError);
  CHECK_THROWS_AS(read_scene_file(folder.path()), InputError);
}

TEST_CASE("a scene file with every key is read as it says") {
  const TemporaryFolder folder;
  const auto path = folder.write("scene.json", R"({
    "graze": 1, "contact_distance": 0.02, "range": "infinity", "detail": "regions",
    "accuracy": {"paper": [24, 14, 8.5]}, "ways_out": true, "carrying": 4, "carrying_band": 0.01, "sweep_tolerance": 1e-9, "swept_gap": 0.125, "frames": 300, "frames_per_second": 60,
    "objects": [
      {"name": "liver", "mesh": "meshes/liver.obj", "node": 2, "positions": "liver_####.ply",
       "transform": {"translate": [1, 2, 3], "rotate_degrees": [10, 20, 30], "scale": 0.5}},
      {"name": "tool", "mesh": "/tools/tool.stl", "node": "blade", "motion": "rigid", "layer": 4,
       "collides_with": 3, "group": 9, "margin": 0.001, "solid": true, "kind": 255, "face_groups": [0, 255, 7], "hidden_groups": [7, 255], "queries": true, "patch_radius": 0.25, "patch_faces": 99, "transform": {"translate": [0, 0, 1], "rotate_degrees": [0, 90, 0]},
       "poses": [{"frame": 0}, {"frame": 100, "translate": [0, 0, 0]}, {"frame": 101, "rotate_degrees": [1, 2, 3]}]},
      {"mesh": "fox.glb", "animation": "Run", "self": true, "self_rings": 8, "self_at_rest": true, "swept": true},
      {"mesh": "floor.obj", "motion": "fixed"}],
    "rules": [{"kinds": [0, 255], "contact_distance": 0.5, "range": "infinity", "epsilon": [3, 2]}, {"kinds": [1, 1]}],
    "ignore": [["liver", "tool"], ["liver", 0, "tool", 255]]})");
  const SceneDescription scene = read_scene_file(path);

  CHECK(scene.settings.contact_distance == 0.02);
  CHECK(scene.settings.range == std::numeric_limits<double>::infinity());
  CHECK(scene.settings.detail == graze::ContactDetail::regions);
  CHECK(scene.settings.accuracy.mode() == graze::AccuracyMode::paper);
  CHECK(scene.settings.accuracy.epsilon() == std::vector<double>{24, 14, 8.5});
  CHECK((scene.settings.ways_out && scene.settings.carrying == 4 && scene.settings.carrying_band == 0.01));
  CHECK((scene.settings.sweep_tolerance == 1e-9 && scene.settings.swept_gap == 0.125));
  CHECK(scene.frames == 300U);
  CHECK(scene.frames_per_second == 60);

  REQUIRE(scene.objects.size() == 4);
  const auto& liver = scene.objects[0];
  CHECK(liver.settings.name == "liver");
  CHECK(liver.mesh == folder.path() / "meshes/liver.obj");
  CHECK(std::get<std::uint32_t>(liver.node.value()) == 2);
  CHECK(liver.settings.motion == graze::Motion::deformable);  // because it has positions
  CHECK(liver.positions == folder / "liver_####.ply");
  CHECK(liver.transform.translate == Eigen::Vector3d(1, 2, 3));
  CHECK(liver.transform.rotation == rotation_from_degrees({10, 20, 30}));
  CHECK(liver.transform.stretch == Eigen::Matrix3d(0.5 * Eigen::Matrix3d::Identity()));
  CHECK((liver.settings.layer == 1 && liver.settings.collides_with == 0xFFFFFFFFU &&
         liver.settings.margin == 0 && liver.settings.kind == 0 && !liver.settings.solid));

  const auto& tool = scene.objects[1];
  CHECK(tool.mesh == "/tools/tool.stl");
  CHECK(std::get<std::string>(tool.node.value()) == "blade");
  CHECK(tool.settings.motion == graze::Motion::rigid);
  CHECK((tool.settings.layer == 4 && tool.settings.collides_with == 3 && tool.settings.group == 9 &&
         tool.settings.margin == 0.001 && tool.settings.solid && tool.settings.queries &&
         tool.settings.kind == 255));
  CHECK((tool.settings.patch_radius == 0.25 && tool.settings.patch_faces == 99));
  CHECK(tool.settings.face_groups == std::vector<std::uint8_t>{0, 255, 7});
  CHECK(tool.settings.hidden_groups == std::vector<std::uint8_t>{7, 255});
  REQUIRE(tool.poses.size() == 3);  // what a key leaves out is the transform's
  CHECK(tool.poses[0].translate == Eigen::Vector3d(0, 0, 1));
  CHECK(tool.poses[0].rotation == rotation_from_degrees({0, 90, 0}));
  CHECK((tool.poses[1].frame == 100 && tool.poses[1].translate == Eigen::Vector3d(0, 0, 0)));
  CHECK(tool.poses[1].rotation == rotation_from_degrees({0, 90, 0}));
  CHECK(tool.poses[2].rotation == rotation_from_degrees({1, 2, 3}));

  CHECK(std::get<std::string>(scene.objects[2].animation.value()) == "Run");
  const graze::ObjectSettings& fox = scene.objects[2].settings;
  CHECK((fox.self && fox.self_rings == 8 && fox.self_at_rest && fox.swept));
  CHECK((!tool.settings.self && !tool.settings.self_at_rest && !tool.settings.swept));
  CHECK(scene.objects[3].settings.motion == graze::Motion::fixed);
  REQUIRE(scene.rules.size() == 2);
  CHECK(scene.rules[0].kinds == std::array<std::uint32_t, 2>{0, 255});
  CHECK(scene.rules[0].contact_distance == 0.5);
  CHECK(scene.rules[0].range == std::numeric_limits<double>::infinity());
  CHECK(scene.rules[0].epsilon == std::vector<double>{3, 2});
  CHECK((!scene.rules[1].contact_distance && !scene.rules[1].range && scene.rules[1].epsilon.empty()));
  REQUIRE(scene.ignore.size() == 2);
  CHECK(scene.ignore[0].names == std::array<std::string, 2>{"liver", "tool"});
  CHECK_FALSE(scene.ignore[0].groups.has_value());
  CHECK(scene.ignore[1].names == scene.ignore[0].names);
  CHECK(scene.ignore[1].groups == std::array<std::uint8_t, 2>{0, 255});
}

TEST_CASE("an object is described by the same defaults as a scene has, and its enumerators have words") {
  CHECK(graze::io::ObjectDescription().settings.motion == graze::ObjectSettings().motion);
  CHECK(to_string(graze::ContactDetail::none) == "none");
  CHECK(graze::to_string(graze::io::UpAxis::y) == "y");
  CHECK(to_string(static_cast<graze::ContactDetail>(200)) == "unknown");
}

TEST_CASE("what a scene file leaves out has its default") {
  const TemporaryFolder folder;
  const SceneDescription scene = read_scene_file(folder.write("scene.json", scene_with("", "")));
  CHECK((scene.settings.contact_distance == 0 && scene.settings.range == 0));
  CHECK(scene.settings.detail == graze::ContactDetail::features);
  CHECK(scene.settings.accuracy.mode() == graze::AccuracyMode::exact);
  CHECK((!scene.settings.ways_out && scene.settings.carrying == 0 && !scene.settings.carrying_band));
  CHECK((scene.settings.sweep_tolerance == 1e-6 && scene.settings.swept_gap == 0));
  CHECK(scene.objects[0].settings.hidden_groups.empty());
  CHECK(scene.objects[0].settings.self_rings == 1);
  CHECK((!scene.frames && scene.frames_per_second == 30));
  CHECK(scene.objects[0].settings.motion == graze::Motion::rigid);
  CHECK((scene.objects[0].settings.name.empty() && !scene.objects[0].node &&
         scene.objects[0].positions.empty()));
  CHECK(scene.objects[0].transform.is_identity());
}
