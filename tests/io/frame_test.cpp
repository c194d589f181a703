// Axes, units and names: one arm from every format.

#include <array>
#include <graze/io/error.hpp>
#include <graze/io/player.hpp>
#include <graze/io/scene_file.hpp>

#include "io/formats/gltf_builder.hpp"

using graze::io::MeshFile;
using graze::io::Player;
using namespace graze::tests;

namespace {

const std::vector<Eigen::Vector3d> arm = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}};
const std::string faces_text = "0 2 1 0 1 3 0 3 2 1 2 3";

std::string numbers_of(const std::string& comma) {
  std::string text;
  for (const auto& point : arm)
    for (const double number : point)
      text += (text.empty() ? "" : comma) + std::to_string(static_cast<int>(number));
  return text;
}

std::string obj() {
  std::string text = "o arm\n";
  for (const auto& p : arm)
    text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  return text + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

std::string stl() {
  std::string text = "solid arm\n";
  for (const auto& face : std::vector<Corners>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto corner : face)
      text += "vertex " + std::to_string(arm[corner].x()) + " " + std::to_string(arm[corner].y()) + " " +
              std::to_string(arm[corner].z()) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid arm\n";
}

std::string gltf() {
  GltfBuffer buffer;
  std::vector<float> positions;
  for (const auto& point : arm)
    for (const double number : point) positions.push_back(static_cast<float>(number));
  buffer.add("VEC3", positions);
  buffer.add_indices({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  return buffer.gltf(
      R"("nodes":[{"name":"arm","mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
}

/// `node_name` is the attribute of the node. If it is empty, the node has none, and its geometry's name
/// counts.
std::string dae(const std::string& up, const std::string& metres, const std::string& node_name) {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         metres + R"("/><up_axis>)" + up + R"(</up_axis></asset>
<library_geometries><geometry id="g" name="arm"><mesh><source id="p"><float_array id="pa" count="12">)" +
         numbers_of(" ") + R"(</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
         faces_text + R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n")" +
         (node_name.empty() ? "" : " name=\"" + node_name + "\"") + R"(><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string fbx(int up, int front, int front_sign, const std::string& unit) {
  const auto number = [](const std::string& key, int value) {
    return "P: \"" + key + R"(", "int", "Integer", "",)" + std::to_string(value) + "\n";
  };
  return R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {
FBXHeaderVersion: 1003
FBXVersion: 7300
}
GlobalSettings:  {
Version: 1000
Properties70:  {
)" + number("UpAxis", up) +
         number("UpAxisSign", 1) + number("FrontAxis", front) + number("FrontAxisSign", front_sign) +
         number("CoordAxis", 0) + number("CoordAxisSign", 1) +
         R"(P: "UnitScaleFactor", "double", "Number", "",)" + unit + R"(
}
}
Objects:  {
Geometry: 100, "Geometry::arm", "Mesh" {
Vertices: *12 {
a: )" + numbers_of(",") +
         R"(
}
PolygonVertexIndex: *12 {
a: 0,2,-2,0,1,-4,0,3,-3,1,2,-4
}
GeometryVersion: 124
}
Model: 200, "Model::arm", "Mesh" {
Version: 232
}
}
Connections:  {
C: "OO",200,0
C: "OO",100,200
}
)";
}

std::string ase() {
  std::string text =
      "*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n*NODE_NAME \"arm\"\n*MESH {\n*MESH_NUMVERTEX "
      "4\n*MESH_NUMFACES 4\n"
      "*MESH_VERTEX_LIST {\n";
  for (std::size_t i = 0; i < arm.size(); ++i)
    text += "*MESH_VERTEX " + std::to_string(i) + " " + std::to_string(arm[i].x()) + " " +
            std::to_string(arm[i].y()) + " " + std::to_string(arm[i].z()) + "\n";
  text += "}\n*MESH_FACE_LIST {\n";
  int number = 0;
  for (const auto& face : std::vector<Corners>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    text += "*MESH_FACE " + std::to_string(number++) + ": A: " + std::to_string(face[0]) +
            " B: " + std::to_string(face[1]) + " C: " + std::to_string(face[2]) +
            " AB: 1 BC: 1 CA: 1 *MESH_SMOOTHING 0 *MESH_MTLID 0\n";
  return text + "}\n}\n}\n";
}

/// Each format with other axes and units. The numbers are the same.
std::vector<std::pair<std::string, std::string>> arms() {
  return {{"arm.obj", obj()},
          {"arm.stl", stl()},
          {"arm.gltf", gltf()},
          {"arm.ase", ase()},
          {"named.dae", dae("Z_UP", "1", "arm")},
          {"metres.dae", dae("Z_UP", "1", "")},
          {"inches.dae", dae("Y_UP", "0.0254", "")},
          {"x_up.dae", dae("X_UP", "0.001", "")},
          {"centimetres.fbx", fbx(1, 2, 1, "1")},
          {"inches.fbx", fbx(1, 2, 1, "2.54")},
          {"metres.fbx", fbx(2, 1, -1, "100")}};
}

/// By value: the order in which corners first appear differs between formats.
std::set<std::tuple<double, double, double>> points_of(const graze::Mesh& mesh) {
  std::set<std::tuple<double, double, double>> points;
  for (const auto& p : mesh.rest()) points.emplace(p.x(), p.y(), p.z());
  return points;
}

Player play(const TemporaryFolder& folder, const std::string& object, const std::string& more = "") {
  return Player(graze::io::read_scene_file(
      folder.write("scene.json", R"({"graze": 1, )" + more + R"("objects": [{)" + object + "}]}")));
}

void check_points(const graze::Mesh& mesh, const Eigen::Matrix3d& map) {
  REQUIRE(mesh.vertex_count() == arm.size());
  for (const auto& point : arm) {
    double nearest = 1e9;
    for (const auto& p : mesh.rest()) nearest = std::min(nearest, (p - map * point).norm());
    CHECK(nearest < 1e-7);
  }
}

double volume_of(const graze::Mesh& mesh) {
  double volume = 0;
  const auto rest = mesh.rest();
  for (const Corners& face : faces_of(mesh))
    volume += rest[face[0]].dot(rest[face[1]].cross(rest[face[2]])) / 6;
  return volume;
}

}  // namespace

TEST_CASE("one arm is at one place, under its own name, from every format") {
  const TemporaryFolder folder;
  std::set<std::tuple<double, double, double>> expected;
  for (const auto& p : arm) expected.emplace(p.x(), p.y(), p.z());
  for (const auto& [name, text] : arms()) {
    INFO(name);
    const AssimpLeaks leaks;
    const auto file = MeshFile::read(folder.write(name, text));
    REQUIRE(file.objects().size() == 1);
    CHECK(file.objects()[0].name == "arm");
    CHECK(points_of(*file.objects()[0].mesh) == expected);
    CHECK(volume_of(*file.objects()[0].mesh) == Approx(5));
    CHECK(file.warnings().empty());
  }
}

TEST_CASE("a COLLADA node's name wins over its geometry's, and both over its id") {
  const TemporaryFolder folder;
  const AssimpLeaks leaks;
  const auto name = [&](const std::string& node_name) {
    return MeshFile::read(folder.write("file.dae", dae("Z_UP", "1", node_name))).objects()[0].name;
  };
  CHECK(name("elbow") == "elbow");
  CHECK(name("") == "arm");
}

TEST_CASE("a file's own axes and unit are told, and applied where a scene file asks for them") {
  const TemporaryFolder folder;
  const Eigen::Matrix3d y_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  const Eigen::Matrix3d x_up{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}};
  struct Row {
    std::string name, text, up;
    double metres;
    Eigen::Matrix3d map;
  };
  const std::vector<Row> table = {{"arm.gltf", gltf(), "y", 1, y_up},
                                  {"z.dae", dae("Z_UP", "1", "arm"), "z", 1, Eigen::Matrix3d::Identity()},
                                  {"y.dae", dae("Y_UP", "0.0254", "arm"), "y", 0.0254, 0.0254 * y_up},
                                  {"x.dae", dae("X_UP", "0.001", "arm"), "x", 0.001, 0.001 * x_up},
                                  {"cm.fbx", fbx(1, 2, 1, "1"), "y", 0.01, 0.01 * y_up},
                                  {"m.fbx", fbx(2, 1, -1, "100"), "z", 1, Eigen::Matrix3d::Identity()}};
  for (const Row& row : table) {
    INFO(row.name);
    const AssimpLeaks leaks;
    const auto file = MeshFile::read(folder.write(row.name, row.text));
    CHECK(file.frame().up == row.up);
    CHECK(file.frame().metres_per_unit.value() == Approx(row.metres));
    const std::string mesh = R"("mesh": ")" + row.name + "\"";
    const Player asked = play(folder, mesh + R"(, "up": "file", "unit": "file")");
    check_points(*asked.objects()[0].mesh, row.map);
    const bool is_converted = row.map != Eigen::Matrix3d::Identity();
    CHECK(asked.warnings().size() == (is_converted ? 1U : 0U));
    if (is_converted) CHECK_THAT(asked.warnings()[0], Catch::Matchers::Contains(row.name + ": converted: "));
    const Player left_alone = play(folder, mesh);
    check_points(*left_alone.objects()[0].mesh, Eigen::Matrix3d::Identity());
    const bool is_told = is_converted && row.name != "arm.gltf";
    CHECK(left_alone.warnings().size() == (is_told ? 1U : 0U));
    if (is_told)
      CHECK_THAT(left_alone.warnings()[0],
                 Catch::Matchers::Contains("taken as they stand, though it says " + row.up));
  }
}

TEST_CASE("a scene file says the axes and unit of a file that does not, and its own") {
  const TemporaryFolder folder;
  folder.write("arm.obj", obj());
  const Eigen::Matrix3d y_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  check_points(*play(folder, R"("mesh": "arm.obj", "up": "y", "unit": "mm")").objects()[0].mesh,
               0.001 * y_up);
  check_points(*play(folder, R"("mesh": "arm.obj", "unit": 0.5)").objects()[0].mesh,
               0.5 * Eigen::Matrix3d::Identity());
  check_points(*play(folder, R"("mesh": "arm.obj", "up": "z", "unit": "m")", R"("up": "y", "unit": "mm", )")
                    .objects()[0]
                    .mesh,
               1000 * y_up.transpose());
  const auto refusal = [&](const std::string& key) {
    try {
      play(folder, R"("mesh": "arm.obj", ")" + key + R"(": "file")");
    } catch (const graze::io::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(refusal("up"),
             Catch::Matchers::Contains("objects[0].up: ") &&
                 Catch::Matchers::EndsWith("does not say which axis points up; write x, y or z"));
  CHECK_THAT(refusal("unit"),
             Catch::Matchers::EndsWith("does not say what its unit is; write it, such as mm"));
}

TEST_CASE("a scale of a scene file may mirror or differ by axis, and the front stays outside") {
  const TemporaryFolder folder;
  folder.write("arm.obj", obj());
  const std::string motion = GENERATE(R"("motion": "rigid")", R"("motion": "deformable")");
  for (const auto& [scale, expected] : {std::pair<std::string, Eigen::Vector3d>("-2", {-2, -2, -2}),
                                        {"[1, -1, 1]", {1, -1, 1}},
                                        {"[1, 2, 3]", {1, 2, 3}}}) {
    INFO(scale);
    const Player player =
        play(folder, R"("mesh": "arm.obj", )" + motion + R"(, "transform": {"scale": )" + scale + "}");
    check_points(*player.objects()[0].mesh, expected.asDiagonal());
    CHECK(volume_of(*player.objects()[0].mesh) == Approx(5 * std::abs(expected.prod())));
  }
}

TEST_CASE("poses are degrees, quaternions or matrices") {
  const TemporaryFolder folder;
  folder.write("arm.obj", obj());
  const auto positions = [&](const std::string& object) {
    Player player = play(folder, R"("mesh": "arm.obj", )" + object);
    player.advance(0);
    std::vector<Eigen::Vector3d> points;
    player.read_positions(0, points);
    return points;
  };
  // A quarter turn about z, then one up.
  const auto expected = positions(R"("transform": {"translate": [0, 0, 1], "rotate_degrees": [0, 0, 90]})");
  CHECK(expected[1] == Eigen::Vector3d(0, 2, 1));
  const std::string quaternion =
      R"("translate": [0, 0, 1], "rotate_quaternion": [0, 0, 0.7071068, 0.7071068])";
  const std::string matrix = R"("matrix": [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])";
  const std::string rough =
      R"("matrix": [[0.00001, -1, 0, 0], [0.99999, 0, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])";
  for (const std::string& way : {quaternion, matrix, rough}) {
    INFO(way);
    const double tolerance = way == rough ? 1e-4 : 1e-7;
    CHECK(largest_difference(positions("\"transform\": {" + way + "}"), expected) < tolerance);
    CHECK(largest_difference(positions(R"("poses": [{"frame": 0, )" + way + "}]"), expected) < tolerance);
  }
  // A matrix of a transform may scale and mirror. The mesh then stays right side out.
  const Player mirrored = play(
      folder,
      R"("mesh": "arm.obj", "transform": {"matrix": [[0, 2, 0, 0], [1, 0, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]})");
  CHECK(volume_of(*mirrored.objects()[0].mesh) == Approx(10));
  std::vector<Eigen::Vector3d> points;
  mirrored.read_positions(0, points);
  CHECK(largest_difference(points, {{0, 0, 1}, {0, 2, 1}, {6, 0, 1}, {0, 0, 6}}) < 1e-12);
}

TEST_CASE("limits of contacts are set by a scene file") {
  const TemporaryFolder folder;
  folder.write("arm.obj", obj());
  const auto scene = graze::io::read_scene_file(folder.write(
      "scene.json",
      R"({"graze": 1, "max_contacts": 7, "max_contacts_per_pair": 3, "objects": [{"mesh": "arm.obj"}]})"));
  CHECK(scene.settings.max_contacts == 7U);
  CHECK(scene.settings.max_contacts_per_pair == 3U);
}

TEST_CASE("a format that is not read is told apart from a damaged file") {
  const TemporaryFolder folder;
  for (const auto& [name, format] : {std::pair<std::string, std::string>("a.vtk", "VTK"),
                                     {"a.msh", "Gmsh or ANSYS"},
                                     {"a.ABC", "Alembic"},
                                     {"a.usd", "USD"},
                                     {"a.usda", "USD"},
                                     {"a.usdc", "USD"},
                                     {"a.usdz", "USD"}})
    CHECK_THAT(refusal_of(folder.write(name, "# vtk DataFile Version 3.0\n")),
               Catch::Matchers::Contains("is " + format + ", a format that is not read"));
  CHECK_THAT(refusal_of(folder.write("a.foo", "words")),
             Catch::Matchers::StartsWith("'.foo' is no format that is read"));
  CHECK_THAT(refusal_of(folder.write("mesh", "words")),
             Catch::Matchers::StartsWith("its name has no ending"));
  CHECK_THAT(refusal_of(folder.write("a.dae", "words")), Catch::Matchers::StartsWith("it cannot be read ("));
}

namespace {

std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

/// A ZIP archive of files that are stored as they are.
std::string archive_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, text] : files) {
    std::string fields;
    for (const std::uint16_t field : std::array<std::uint16_t, 5>{20, 0, 0, 0, 33}) append(fields, field);
    append(fields, crc_of(text));
    for (int i = 0; i < 2; ++i) append(fields, static_cast<std::uint32_t>(text.size()));
    append(fields, static_cast<std::uint16_t>(name.size()));
    append<std::uint16_t>(fields, 0);
    directory += std::string("PK\x01\x02\x14\0", 6) + fields + std::string(10, '\0');
    append(directory, static_cast<std::uint32_t>(archive.size()));
    directory += name;
    archive += "PK\x03\x04" + fields + name + text;
  }
  std::string end("PK\x05\x06\0\0\0\0", 8);
  for (int i = 0; i < 2; ++i) append(end, static_cast<std::uint16_t>(files.size()));
  append(end, static_cast<std::uint32_t>(directory.size()));
  append(end, static_cast<std::uint32_t>(archive.size()));
  return archive + directory + end + std::string(2, '\0');
}

std::string threemf(const std::string& unit) {
  std::string vertices;
  for (const auto& p : arm)
    vertices += "<vertex x=\"" + std::to_string(p.x()) + "\" y=\"" + std::to_string(p.y()) + "\" z=\"" +
                std::to_string(p.z()) + "\"/>";
  const std::string ns = "http://schemas.openxmlformats.org/package/2006/";
  return archive_of(
      {{"[Content_Types].xml", "<?xml version=\"1.0\"?><Types xmlns=\"" + ns + "content-types\"></Types>"},
       {"_rels/.rels",
        "<?xml version=\"1.0\"?><Relationships xmlns=\"" + ns +
            "relationships\"><Relationship Target=\"/3D/3dmodel.model\" Id=\"r0\" "
            "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
       {"3D/3dmodel.model",
        "<?xml version=\"1.0\"?><model" + unit +
            " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><object "
            "id=\"1\" "
            "type=\"model\"><mesh><vertices>" +
            vertices +
            R"(</vertices><triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>)"
            R"(<triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles></mesh></object>)"
            R"(</resources><build><item objectid="1"/></build></model>)"}});
}

}  // namespace

TEST_CASE("a 3MF file says its unit, which is a millimetre where it names none") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, double>> units = {
      {"", 0.001}, {R"( unit="millimeter")", 0.001}, {" unit='inch'", 0.0254}, {R"( unit="meter")", 1}};
  for (const auto& [unit, metres] : units) {
    INFO(unit);
    const auto path = folder.write("arm.3mf", threemf(unit));
    const auto file = MeshFile::read(path);
    CHECK(file.frame().metres_per_unit == metres);
    CHECK(file.frame().up == "z");
    const auto scene = folder.write(
        "scene.json", R"({"graze": 1, "objects": [{"mesh": "arm.3mf", "up": "file", "unit": "file"}]})");
    const Player player(graze::io::read_scene_file(scene));
    std::vector<Eigen::Vector3d> positions;
    player.read_positions(0, positions);
    double highest = 0;
    for (const auto& point : positions) highest = std::max(highest, point.z());
    CHECK(highest == Approx(5 * metres));
  }
  const auto packed = assimp_model("3MF/box.3mf");
  if (is_missing(packed)) return;
  CHECK(MeshFile::read(packed).frame().metres_per_unit == 0.001);
}
