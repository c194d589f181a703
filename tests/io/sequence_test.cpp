#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/motion.hpp>

#include "io/formats/gltf_builder.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

std::vector<Eigen::Vector3d> frame_positions(int frame) {
  return {{0, 0, 0.1 * frame}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5.0 * frame}};
}

std::string obj_frame(int frame) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& p : frame_positions(frame)) text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  text << "g one\nf 1 2 3\nf 1 3 4\ng two\nf 1 3 2\nf 1 4 3\n";
  return text.str();
}

std::string ply_frame(int frame) {
  std::ostringstream text;
  text.precision(17);
  text << "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
       << "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& p : frame_positions(frame)) text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  text << "3 0 1 2\n";
  return text.str();
}

std::string refusal(const std::filesystem::path& pattern, const graze::Mesh& mesh, std::size_t object = 0) {
  try {
    const auto source = io::open_sequence(pattern, mesh, object);
    std::vector<Eigen::Vector3d> positions;
    for (std::uint32_t frame = 0; frame < source->frame_count(); ++frame) source->read(frame, positions);
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a sequence is read in order of its numbers, past the end the last frame holds") {
  const TemporaryFolder folder;
  const auto extension = GENERATE(as<std::string>(), ".obj", ".ply");
  // Frame k is the k-th file by number: 3, 20, 100, 1000.
  const std::vector<std::string> names = {"a_003", "a_020", "a_100", "a_1000"};
  for (int frame = 3; frame >= 0; --frame)
    folder.write(names[static_cast<std::size_t>(frame)] + extension,
                 extension == ".obj" ? obj_frame(frame) : ply_frame(frame));
  for (const std::string other : {"a_02", "b_003", "a_x03", "a_", "a_003.bak"})
    folder.write(other + extension, "junk");
  const auto file = io::MeshFile::read(folder / (names[0] + extension));
  const auto& mesh = *file.objects()[0].mesh;
  REQUIRE(mesh.vertex_count() == 4);
  const auto source = io::open_sequence(folder / ("a_###" + extension), mesh, 0);
  REQUIRE(source->frame_count() == 4);
  std::vector<Eigen::Vector3d> positions;
  for (const std::uint32_t frame : {0U, 3U, 1U, 2U, 9U}) {
    source->read(frame, positions);
    CHECK(positions == frame_positions(static_cast<int>(std::min(frame, 3U))));
  }
}

TEST_CASE("a sequence of another count is refused by file, frame and counts") {
  const TemporaryFolder folder;
  const auto extension = GENERATE(as<std::string>(), ".obj", ".ply", ".off");
  const auto frame = [&](int number) {
    if (extension == ".obj") return obj_frame(number);
    if (extension == ".ply") return ply_frame(number);
    return std::string("OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 2\n");
  };
  folder.write("s1" + extension, frame(1));
  folder.write("s2" + extension, frame(2));
  const std::string three = extension == ".obj" ? "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                            : extension == ".off"
                                ? "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
                                : "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                  "property float y\nproperty float z\nend_header\n0 0 0 1 0 0 0 1 0";
  const auto last = folder.write("s3" + extension, three);
  const auto file = io::MeshFile::read(folder / ("s1" + extension));
  CHECK(refusal(folder / ("s#" + extension), *file.objects()[0].mesh) ==
        last.string() +
            ": frame 2: the file has 3 vertices, the mesh 4; write every frame with the mesh's vertices");
}

TEST_CASE("a sequence says which frame has other faces, and which one is cut") {
  const TemporaryFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";
  const std::string faces = "f 1 2 3 4\nf 1 5 2\n";
  const auto notes = [&](const std::vector<std::string>& frames) {
    const auto file = io::MeshFile::read(folder.write("mesh.obj", vertices + faces));
    for (std::size_t i = 0; i < frames.size(); ++i) folder.write("f" + std::to_string(i) + ".obj", frames[i]);
    const auto source = io::open_sequence(folder / "f#.obj", file.objects()[0], 0);
    std::vector<Eigen::Vector3d> positions;
    for (std::uint32_t frame = 0; frame < frames.size(); ++frame) source->read(frame, positions);
    std::vector<std::string> said;
    for (const std::string& note : source->warnings()) {
      CHECK(note.starts_with((folder / "f").string()));
      said.push_back(note.substr((folder / "f").string().size()));
    }
    return said;
  };
  const std::string same = vertices + faces;
  CHECK(notes({same, vertices, same, vertices + "f 2 1 5\nf 1 2 3 4\n"}).empty());
  CHECK(notes({same, same, vertices + "f 1 2 3\nf 1 3 4\nf 1 5 2\n", vertices + "f 1 2 4\n"}) ==
        std::vector<std::string>{
            "2.obj: frame 2: 2 of its 3 faces are not the mesh's, so its vertices may be in "
            "another order; write every frame with the mesh's faces"});
  CHECK(notes({same, vertices + "f 1 5 2\n", same}) ==
        std::vector<std::string>{
            "1.obj: frame 1: its faces have 1 triangles and the mesh's 3; write every frame "
            "with the mesh's faces"});
  CHECK(notes({same, same.substr(0, same.size() - 1), vertices.substr(0, vertices.size() - 1)}) ==
        std::vector<std::string>{
            "1.obj: frame 1: it ends within a line, as the first frame does not, so its last "
            "number may be cut; write it again"});
  CHECK(notes({vertices.substr(0, vertices.size() - 1), same.substr(0, same.size() - 1)}).empty());
}

TEST_CASE("an object of an OBJ file of several groups is moved by its own vertices or by all of the file") {
  const TemporaryFolder folder;
  const auto text = [](double height, const std::string& groups) {
    std::string lines;
    for (int i = 0; i < 6; ++i)
      lines +=
          "v " + std::to_string(i) + " " + std::to_string(i % 2) + " " + std::to_string(height + i) + "\n";
    return lines + groups;
  };
  const std::string groups = "g one\nf 1 2 3\ng two\nf 2 4 6\n";
  const auto file = io::MeshFile::read(folder.write("mesh.obj", text(0, groups)));
  folder.write("same_0.obj", text(7, groups));
  folder.write("all_0.obj", text(7, ""));
  folder.write("other_0.obj", text(7, "g one\nf 1 2 3\ng two\nf 2 4 5\n"));
  for (const std::string name : {"same_#.obj", "all_#.obj"}) {
    std::vector<Eigen::Vector3d> positions;
    const auto source = io::open_sequence(folder / name, file.objects()[1], name[0] == 's' ? 1 : 0);
    source->read(0, positions);
    CHECK(positions == std::vector<Eigen::Vector3d>{{1, 1, 8}, {3, 1, 10}, {5, 1, 12}});
    CHECK(source->warnings().empty());
  }
  const auto other = io::open_sequence(folder / "other_#.obj", file.objects()[1], 1);
  REQUIRE(other->warnings().size() == 1);
  CHECK_THAT(other->warnings()[0],
             Catch::Matchers::Contains("use other vertices of the file than the mesh's"));
}

TEST_CASE("a sequence that is not there or not clear is refused") {
  const TemporaryFolder folder;
  folder.write("s01.obj", obj_frame(0));
  folder.write("s001.obj", obj_frame(1));
  folder.write("t1.obj", obj_frame(1));
  folder.write("t2.obj", "v 1 2 three\n");
  folder.write("u1.obj", obj_frame(1));
  const auto file = io::MeshFile::read(folder / "s01.obj");
  const auto& mesh = *file.objects()[0].mesh;
  using Catch::Matchers::Contains;
  CHECK_THAT(refusal(folder / "s##.obj", mesh), Contains("'s001.obj' and 's01.obj' have one number"));
  CHECK_THAT(refusal(folder / "v##.obj", mesh), Contains("no file has such a name"));
  CHECK_THAT(refusal(folder / "s.obj", mesh), Contains("the file name has no #"));
  CHECK_THAT(refusal(folder / "s#_#.obj", mesh), Contains("several runs of #"));
  CHECK_THAT(refusal(folder / "none" / "s#.obj", mesh), Contains("its folder cannot be read"));
  CHECK_THAT(refusal(folder / "t#.obj", mesh), Contains("t2.obj: line 1: a vertex needs three numbers"));
  CHECK(refusal(folder / "u#.obj", mesh, 1).empty());
  CHECK_THAT(refusal(folder / "u#.obj", mesh, 2), Contains("u1.obj: frame 0: there is no object 2"));
}

TEST_CASE("a frame of a sequence may hold NaN and need no face") {
  const TemporaryFolder folder;
  folder.write("n0.ply", ply_frame(0));
  folder.write(
      "n1.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n0 0 0 nan 0 0 0 inf 0 1 1 1\n");
  const auto file = io::MeshFile::read(folder / "n0.ply");
  const auto source = io::open_sequence(folder / "n#.ply", *file.objects()[0].mesh, 0);
  std::vector<Eigen::Vector3d> positions;
  source->read(1, positions);
  CHECK(std::isnan(positions[1].x()));
  CHECK(std::isinf(positions[2].y()));
  CHECK(positions[3] == Eigen::Vector3d(1, 1, 1));
}

TEST_CASE("an animation is sampled at frames of its rate up to its end") {
  GltfBuffer buffer;
  const auto p = std::to_string(buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const auto times = std::to_string(buffer.add("SCALAR", {0, 0.75F}));
  const auto moves = std::to_string(buffer.add("VEC3", {0, 0, 0, 0, 0, 3}));
  const TemporaryFolder folder;
  const auto file = io::MeshFile::read(folder.write(
      "move.gltf",
      buffer.gltf(
          R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
          R"({"POSITION":)" +
          p + R"(}}]}],"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],)" +
          R"("samplers":[{"input":)" + times + R"(,"output":)" + moves + "}]}]")));
  const auto source = io::open_animation(file, 0, 0, 10);
  REQUIRE(source->frame_count() == 9);  // 0 to 0.7 s in steps of 0.1 s, and 0.8 s, which is the end held
  CHECK(io::open_animation(file, 0, 0, 4)->frame_count() == 4);
  CHECK(io::open_animation(file, 0, 0, 0.001)->frame_count() == 2);
  std::vector<Eigen::Vector3d> positions;
  for (const std::uint32_t frame : {5U, 8U, 0U, 100U}) {
    source->read(frame, positions);
    const double height = 4 * std::min(0.1 * frame, 0.75);
    CHECK(largest_difference(positions, {{0, 0, height}, {1, 0, height}, {0, 1, height}}) < 1e-6);
  }
  CHECK_THROWS_AS(io::open_animation(file, 1, 0, 10), graze::Error);
  CHECK_THROWS_AS(io::open_animation(file, 0, 1, 10), graze::Error);
  CHECK_THROWS_AS(io::open_animation(file, 0, 0, 0), graze::Error);
  CHECK_THROWS_AS(io::open_animation(file, 0, 0, NAN), graze::Error);
}

TEST_CASE("every platform's NaN and infinity in a frame is a number that is not finite") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, double>> words = {
      {"nan", 0},        {"-nan", 0},       {"NaN", 0},     {"nan(ind)", 0},    {"-nan(ind)", 0},
      {"nan(snan)", 0},  {"-nan(snan)", 0}, {"NaNQ", 0},    {"-NaNS", 0},       {"1.#IND", 0},
      {"-1.#IND", 0},    {"-1.#IND00", 0},  {"1.#QNAN", 0}, {"1.#QNAN0", 0},    {"1.#SNAN", 0},
      {"1.#J", 0},       {"1.#R", 0},       {"inf", 1},     {"-inf", -1},       {"+INF", 1},
      {"Infinity", 1},   {"-infinity", -1}, {"1.#INF", 1},  {"-1.#INF", -1},    {"1.#INF00e+000", 1},
      {"-1.#INF00", -1}, {"1.#INFe+00", 1}, {"1.#IO", 0},   {"-1.#QNANe+00", 0}};
  const std::string face = "f 1 2 3\n";
  const auto mesh =
      io::MeshFile::read(folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + face)).objects()[0].mesh;
  for (const auto& [word, sign] : words) {
    INFO(word);
    folder.write("frame_0.obj", "v " + word + " 0 0\nv 1 0 0\nv 0 1 0\n" + face);
    folder.write(
        "ply_0.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
            word + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    folder.write("off_0.off", "OFF\n3 1 0\n" + word + " 0 0\n1 0 0 # corner\n0 1 0\n3 0 1 2\n");
    for (const char* pattern : {"frame_#.obj", "ply_#.ply", "off_#.off"}) {
      std::vector<Eigen::Vector3d> positions;
      graze::io::open_sequence(folder / pattern, *mesh, 0)->read(0, positions);
      CHECK(std::isnan(positions[0].x()) == (sign == 0));
      if (sign != 0) CHECK(positions[0].x() == sign * std::numeric_limits<double>::infinity());
      CHECK(positions[1] == Eigen::Vector3d(1, 0, 0));
    }
  }
  for (const char* word : {"nano", "1.#", "1.#INFINITE", "1.#IND x", "#IND", "in", "infinit", "1.#1x"}) {
    INFO(word);
    folder.write("bad_0.obj", "v " + std::string(word) + " 0 0\nv 1 0 0\nv 0 1 0\n" + face);
    CHECK_THROWS_AS(graze::io::open_sequence(folder / "bad_#.obj", *mesh, 0), graze::io::InputError);
  }
}
