#include <graze/io/error.hpp>
#include <graze/io/player.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Eigen::Vector3d;
using graze::io::InputError;
using graze::io::Player;
using graze::tests::TemporaryFolder;

constexpr auto triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr auto two_groups_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\ng left\nf 1 2 3\ng right\nf 4 5 6\n";

std::string triangle_at(double x) {
  const std::string shift = std::to_string(x);
  return "v " + shift + " 0 0\nv " + std::to_string(x + 1) + " 0 0\nv " + shift + " 1 0\nf 1 2 3\n";
}

Player play(const TemporaryFolder& folder, const std::string& rest_of_scene) {
  return Player(
      graze::io::read_scene_file(folder.write("scene.json", R"({"graze": 1, )" + rest_of_scene + "}")));
}

std::string error_of(const TemporaryFolder& folder, const std::string& rest_of_scene) {
  try {
    Player player = play(folder, rest_of_scene);
    for (std::uint32_t frame = 0; frame < player.frame_count(); ++frame) player.advance(frame);
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.what();
  }
  return "accepted";
}

std::vector<Vector3d> positions_of(const Player& player, std::size_t index) {
  std::vector<Vector3d> positions;
  player.read_positions(index, positions);
  return positions;
}

std::vector<std::string> names_of(const Player& player) {
  std::vector<std::string> names;
  for (const auto& object : player.objects()) names.push_back(object.name);
  return names;
}

}  // namespace

TEST_CASE("objects are named after their entry, their node, and apart from each other") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  folder.write("two.obj", two_groups_obj);
  const Player player = play(folder, R"("objects": [{"name": "pair", "mesh": "two.obj"}, {"mesh": "two.obj"},
      {"name": "left", "mesh": "one.obj"}, {"name": "only", "mesh": "two.obj", "node": "right"},
      {"mesh": "two.obj", "node": 0}])");
  CHECK(names_of(player) ==
        std::vector<std::string>{"pair/left", "pair/right", "left#2", "right", "left", "only", "left#3"});
}

TEST_CASE("a rigid object stands where its scale, transform and poses put it") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  Player player = play(folder, R"("objects": [
      {"mesh": "one.obj", "transform": {"translate": [0, 0, 7], "rotate_degrees": [0, 0, 90], "scale": 2},
       "poses": [{"frame": 0}, {"frame": 4, "translate": [4, 0, 7]}]}])");
  CHECK(player.frame_count() == 5);
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    player.advance(frame);
    const double x = frame < 4 ? frame : 4;
    CHECK(positions_of(player, 0) == std::vector<Vector3d>{{x, 0, 7}, {x, 2, 7}, {x - 2, 0, 7}});
  }
}

TEST_CASE("a deformable object's transform applies to every frame, and its last frame holds") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  for (int i = 0; i < 3; ++i) folder.write("one_" + std::to_string(10 * i) + ".obj", triangle_at(i));
  Player player = play(folder, R"("objects": [
      {"mesh": "one.obj", "positions": "one_#.obj",
       "transform": {"translate": [0, 0, 7], "rotate_degrees": [0, 0, 90], "scale": 2}}])");
  CHECK(player.frame_count() == 3);
  CHECK(positions_of(player, 0) == std::vector<Vector3d>{{0, 0, 7}, {0, 2, 7}, {-2, 0, 7}});
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    player.advance(frame);
    const double y = 2.0 * (frame < 2 ? frame : 2);
    CHECK(positions_of(player, 0) == std::vector<Vector3d>{{0, y, 7}, {0, y + 2, 7}, {-2, y, 7}});
  }
}

TEST_CASE("objects that are ignored, by entry or by name, are never a pair") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  folder.write("two.obj", two_groups_obj);
  const std::string objects = R"("contact_distance": 0.1, "objects": [
      {"name": "pair", "mesh": "two.obj"}, {"name": "a", "mesh": "one.obj"},
      {"name": "b", "mesh": "one.obj"}])";
  const auto pairs = [&](const std::string& ignored) {
    Player player = play(folder, objects + ignored);
    player.advance(0);
    return player.scene().step()->pairs().size();
  };
  CHECK(pairs("") == 3);  // left-a, left-b, a-b
  CHECK(pairs(R"(, "ignore": [["pair", "a"]])") == 2);
  CHECK(pairs(R"(, "ignore": [["pair/right", "a"]])") == 3);
  CHECK(pairs(R"(, "ignore": [["a", "b"], ["b", "pair/left"]])") == 1);
}

TEST_CASE("the objects of an entry that is ignored with itself meet other objects only") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  std::string crowd;
  constexpr int count = 1001;
  for (int i = 0; i < count; ++i)
    crowd += "g m" + std::to_string(i) + "\nv 0 0 " + std::to_string(i) + "\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
  folder.write("crowd.obj", crowd);
  folder.write("few.obj", crowd.substr(0, crowd.find("g m3\n")));
  const auto pairs = [&](const std::string& keys, const std::string& ignored) {
    Player player = play(folder, R"("objects": [{"name": "few", "mesh": "few.obj")" + keys +
                                     R"(}, {"name": "a", "mesh": "one.obj"}], "range": 10)" + ignored);
    player.advance(0);
    return player.scene().step()->pairs().size();
  };
  CHECK(pairs("", "") == 6);
  CHECK(pairs("", R"(, "ignore": [["few", "few"]])") == 3);
  CHECK(pairs(R"(, "group": 7)", R"(, "ignore": [["few", "few"]])") == 3);
  CHECK(pairs("", R"(, "ignore": [["few", "few"], ["few", "a"]])") == 0);
  // Each pair of two entries is kept one by one, so there is a limit.
  CHECK_THAT(
      error_of(folder, R"("objects": [{"name": "a", "mesh": "crowd.obj"}, {"name": "b", "mesh": "crowd.obj"}],
                                  "ignore": [["a", "a"], ["a", "b"]])"),
      Catch::Matchers::EndsWith("ignore[1]: 1002001 pairs are ignored up to here, and 1000000 may be; "
                                "give the objects a \"group\", or \"layer\" and \"collides_with\""));
}

TEST_CASE("faces that are ignored by their groups are never in a pair") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  folder.write("two.obj", two_groups_obj);
  const std::string objects = R"("contact_distance": 0.1, "objects": [
      {"name": "pair", "mesh": "two.obj", "face_groups": [4]},
      {"name": "a", "mesh": "one.obj", "face_groups": [255]}, {"name": "b", "mesh": "one.obj"}])";
  const auto pairs = [&](const std::string& ignored) {
    Player player = play(folder, objects + ignored);
    player.advance(0);
    return player.scene().step()->pairs().size();
  };
  CHECK(pairs("") == 3);  // left-a, left-b, a-b
  CHECK(pairs(R"(, "ignore": [["a", 0, "b", 0]])") == 3);
  CHECK(pairs(R"(, "ignore": [["a", 255, "b", 0]])") == 2);
  CHECK(pairs(R"(, "ignore": [["b", 0, "pair", 4], ["pair/left", 4, "a", 255]])") == 1);
  CHECK(pairs(R"(, "ignore": [["a", 255, "a", 255], ["pair", 4, "pair", 4]])") == 3);
}

TEST_CASE("a scene that does not fit its files is refused by file and place") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  folder.write("two.obj", two_groups_obj);
  folder.write("bad_0.obj", triangle_obj);
  folder.write("bad_1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n");
  const auto object = [&](const std::string& keys) {
    return error_of(folder, R"("objects": [{"name": "thing", )" + keys + "}]");
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(object(R"("mesh": "none.obj")"), Contains("none.obj"));
  CHECK_THAT(
      object(R"("mesh": "two.obj", "node": "middle")"),
      Contains("objects[0].node: no \"middle\" in the mesh file; the file has 0 \"left\", 1 \"right\""));
  CHECK_THAT(object(R"("mesh": "two.obj", "node": 2)"), Contains("objects[0].node: no number 2"));
  CHECK_THAT(object(R"("mesh": "one.obj", "animation": 0)"), Contains("objects[0].animation: no number 0"));
  CHECK_THAT(object(R"("mesh": "two.obj", "positions": "bad_#.obj")"), Contains("holds 2 objects; pick one"));
  CHECK_THAT(object(R"("mesh": "one.obj", "positions": "bad.obj")"), Contains("objects[0].positions: "));
  CHECK_THAT(object(R"("mesh": "one.obj", "positions": "none_#.obj")"), Contains("none_#.obj"));
  CHECK_THAT(object(R"("mesh": "one.obj", "positions": "none.pc2")"), Contains("none.pc2"));
  CHECK_THAT(object(R"("mesh": "one.obj", "positions": "bad_#.obj")"), Contains("bad_1.obj"));
  CHECK_THAT(error_of(folder, R"("objects": [{"mesh": "one.obj"}], "ignore": [["one", "none"]])"),
             Contains("ignore[0]: no object is called \"none\"; the scene has "));
  CHECK_THAT(error_of(folder, R"("objects": [{"mesh": "one.obj", "name": "a"}], "ignore": [["a", "a"]])"),
             Contains("ignore[0]: names one object twice"));
  CHECK_THAT(object(R"("mesh": "one.obj", "face_groups": [0, 1])"),
             Contains("objects[0]: object 'thing': face_groups has 2 groups for 1 faces"));
  CHECK_THAT(error_of(folder, R"("accuracy": {"paper": [1]}, "objects": [{"mesh": "one.obj"}])"),
             Contains("scene.json: "));
}

TEST_CASE("a file of a sequence that fails midway is refused by its name and the frame") {
  const TemporaryFolder folder;
  folder.write("one.obj", triangle_obj);
  for (int i = 0; i < 4; ++i) folder.write("cloth_" + std::to_string(i) + ".obj", triangle_at(i));
  Player player =
      play(folder, R"("objects": [{"name": "cloth", "mesh": "one.obj", "positions": "cloth_#.obj"}])");
  player.advance(0);
  folder.write("cloth_2.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n");
  player.advance(1);
  std::string message;
  try {
    player.advance(2);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK_THAT(message, Catch::Matchers::Contains("cloth_2.obj"));
  CHECK_THAT(message, Catch::Matchers::Contains("object \"cloth\", frame 2"));
}
