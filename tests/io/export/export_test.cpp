// Exports are compared with the reports of a replay: tables, time series for ParaView, glTF.

#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cstdlib>
#include <graze/io/error.hpp>
#include <graze/io/gltf_writer.hpp>
#include <graze/io/mesh_file.hpp>
#include <graze/io/paraview_series.hpp>
#include <graze/io/table_writers.hpp>
#include <graze/scene_enumerators.hpp>
#include <iostream>
#include <limits>
#include <locale>
#include <map>
#include <sstream>

#include "io/export/export_support.hpp"
#include "io/marked_report.hpp"
#include "support/catch.hpp"

namespace {

using namespace graze;         // NOLINT: the vocabulary of these tests
using namespace graze::tests;  // NOLINT: the vocabulary of these tests
using Eigen::Vector3d;
using Rows = std::vector<std::vector<std::string>>;

/// The cells of a file by RFC 4180.
Rows read_csv(const std::filesystem::path& path) {
  Rows rows(1);
  std::string cell;
  bool is_quoted = false;
  const std::string text = read_file(path);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && is_quoted && i + 1 < text.size() && text[i + 1] == '"')
      cell += text[i++];
    else if (text[i] == '"')
      is_quoted = !is_quoted;
    else if (is_quoted || (text[i] != ',' && text[i] != '\n'))
      cell += text[i];
    else {
      rows.back().push_back(std::exchange(cell, {}));
      if (text[i] == '\n') rows.emplace_back();
    }
  }
  REQUIRE(rows.back().empty());  // the last line ends too
  rows.pop_back();
  return rows;
}

/// Takes the cells of a row one after the other.
class Cells {
 public:
  explicit Cells(const std::vector<std::string>& row) : row_(row) {}

  [[nodiscard]] std::string text() { return row_.at(next_++); }
  [[nodiscard]] std::uint64_t whole() { return std::stoull(text()); }
  /// Whether the next cells are the numbers of a point, to the last bit.
  [[nodiscard]] bool are(const Vector3d& point) {
    bool are_same = true;
    for (int axis = 0; axis < 3; ++axis) are_same = is(point[axis]) && are_same;
    return are_same;
  }
  [[nodiscard]] bool is(double number) {
    return std::bit_cast<std::uint64_t>(std::strtod(text().c_str(), nullptr)) ==
           std::bit_cast<std::uint64_t>(number);
  }
  [[nodiscard]] bool are(const Feature& feature) {
    const bool is_kind = text() == to_string(feature.kind);
    return whole() == feature.index && is_kind;
  }
  [[nodiscard]] bool are_done() const { return next_ == row_.size(); }

 private:
  const std::vector<std::string>& row_;
  std::size_t next_ = 0;
};

void check_beginning(Cells& cells, const io::SceneSnapshot& snapshot, const PairReport& pair) {
  CHECK(cells.whole() == snapshot.frame);
  CHECK(cells.whole() == snapshot.frame + 1);  // a scene's first step is 1
  const std::vector<std::string> names{"sheet, \"wide\"", "spike\n2", "block"};
  const std::uint64_t a = cells.whole();
  const std::uint64_t b = cells.whole();
  CHECK(a == pair.a.index);  // no slot is used twice here
  CHECK(b == pair.b.index);
  CHECK(cells.text() == names.at(a));
  CHECK(cells.text() == names.at(b));
}

void check_contact(Cells cells, const io::SceneSnapshot& snapshot, const PairReport& pair,
                   const Contact& contact) {
  check_beginning(cells, snapshot, pair);
  CHECK(cells.text() == to_string(contact.kind));
  CHECK(cells.text() == to_string(contact.side_a));
  CHECK(cells.text() == to_string(contact.side_b));
  CHECK(cells.are(contact.feature_a));
  CHECK(cells.are(contact.feature_b));
  CHECK(cells.are(contact.point_a));
  CHECK(cells.are(contact.point_b));
  CHECK(cells.are(contact.normal));
  CHECK(cells.is(contact.distance));
  CHECK(cells.whole() == contact.since - 1);
  CHECK(cells.is(contact.separation()));
  CHECK(cells.are(contact.push()));
  CHECK(cells.text() == (contact.sunk ? "true" : "false"));
  CHECK(cells.are_done());
}

void check_row(Cells cells, const io::SceneSnapshot& snapshot, const PairReport& pair) {
  check_beginning(cells, snapshot, pair);
  CHECK(cells.text() == to_string(pair.phase));
  CHECK(cells.is(pair.distance.lower));
  CHECK(cells.is(pair.distance.upper));
  CHECK(cells.are(pair.witness.feature_a));
  CHECK(cells.are(pair.witness.feature_b));
  CHECK(cells.are(pair.witness.point_a));
  CHECK(cells.are(pair.witness.point_b));
  CHECK(cells.whole() == pair.contact_count);
  CHECK(cells.text() == (pair.complete ? "true" : "false"));
  CHECK(cells.text() == (pair.contacts_cut ? "true" : "false"));
  CHECK(cells.text() == (pair.stale ? "true" : "false"));
  CHECK(cells.text() == to_string(pair.inside));
  const WayOut& way = pair.way_out;
  if (way.point == Vector3d::Zero()) {
    for (int i = 0; i < 9; ++i) CHECK(cells.text().empty());
  } else {
    CHECK(cells.are(way.direction));
    CHECK(cells.are(way.point));
    CHECK(cells.is(way.fullness));
    CHECK(cells.is(way.thickness));
    CHECK(cells.is(way.extent));
  }
  if (pair.contact_count == 0) {
    CHECK(cells.text().empty());
  } else {
    double deepest = std::numeric_limits<double>::infinity();
    for (const Contact& contact : snapshot.report->contacts(pair))
      deepest = std::min(deepest, contact.separation());
    CHECK(cells.is(deepest));
  }
  CHECK(cells.are_done());
}

/// Writes numbers as 1.234,5.
struct CommaNumbers : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\1"; }
};

/// The arrays of a .vtp file by their names, as tests/io/export/read_vtp.py prints them.
std::map<std::string, std::vector<std::string>> read_vtp(const std::filesystem::path& path) {
  const std::filesystem::path printed = path.string() + ".txt";
  const std::string command =
      "python3 '" GRAZE_READ_VTP "' '" + path.string() + "' >'" + printed.string() + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  std::map<std::string, std::vector<std::string>> arrays;
  std::istringstream lines(read_file(printed));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    for (std::string word; words >> word;) arrays[name].push_back(word);
  }
  return arrays;
}

/// How Python prints a double, and how C++ reads it again.
struct Printed {
  std::vector<double> numbers;

  explicit Printed(const std::vector<std::string>& array) {
    for (std::size_t i = 2; i < array.size(); ++i) numbers.push_back(std::strtod(array[i].c_str(), nullptr));
  }
};

void append(std::vector<double>& numbers, const Vector3d& point) {
  numbers.insert(numbers.end(), point.data(), point.data() + 3);
}

void check_vtp_surfaces(const std::filesystem::path& path, const io::SceneSnapshot& snapshot) {
  auto arrays = read_vtp(path);
  std::vector<double> points;
  std::vector<double> corners;
  std::vector<double> ends;
  std::vector<double> serials;
  for (const io::SnapshotObject& object : snapshot.objects) {
    const double first = static_cast<double>(points.size()) / 3;
    for (std::uint32_t vertex = 0; vertex < object.mesh->vertex_count(); ++vertex)
      append(points, object.positions[object.mesh->is_used(vertex) ? vertex : 0]);
    for (std::uint32_t face = 0; face < object.mesh->face_count(); ++face) {
      for (const std::uint32_t corner : object.mesh->face(face)) corners.push_back(first + corner);
      ends.push_back(static_cast<double>(corners.size()));
      serials.push_back(static_cast<double>(object.serial));
    }
  }
  CHECK(arrays["counts"] == std::vector<std::string>{std::to_string(points.size() / 3), "0", "0", "0",
                                                     std::to_string(ends.size())});
  CHECK(Printed(arrays["Points/Points"]).numbers == points);
  CHECK(Printed(arrays["Polys/connectivity"]).numbers == corners);
  CHECK(Printed(arrays["Polys/offsets"]).numbers == ends);
  CHECK(Printed(arrays["CellData/object"]).numbers == serials);
  CHECK(arrays["CellData/face"].size() == 2 + ends.size());
  CHECK(arrays["PointData/vertex"].size() == 2 + points.size() / 3);
}

void check_vtp_contacts(const std::filesystem::path& path, const io::SceneSnapshot& snapshot) {
  auto arrays = read_vtp(path);
  std::map<std::string, std::vector<double>> expected;
  for (const PairReport& pair : snapshot.report->pairs())
    for (const Contact& contact : snapshot.report->contacts(pair)) {
      append(expected["Points/Points"], contact.point_a);
      append(expected["PointData/point_b"], contact.point_b);
      append(expected["PointData/normal"], contact.normal);
      expected["PointData/distance"].push_back(contact.distance);
      expected["PointData/kind"].push_back(static_cast<double>(contact.kind));
      expected["PointData/sides"].push_back(static_cast<double>(contact.side_a));
      expected["PointData/sides"].push_back(static_cast<double>(contact.side_b));
      expected["PointData/sunk"].push_back(contact.sunk ? 1 : 0);
      expected["PointData/object_a"].push_back(pair.a.index);
      expected["PointData/object_b"].push_back(pair.b.index);
      expected["PointData/features"].push_back(contact.feature_a.index);
      expected["PointData/features"].push_back(contact.feature_b.index);
    }
  const std::string count = std::to_string(snapshot.report->contacts().size());
  CHECK(arrays["counts"] == std::vector<std::string>{count, count, "0", "0", "0"});
  for (const auto& [name, numbers] : expected) {
    CAPTURE(name);
    CHECK(Printed(arrays[name]).numbers == numbers);
  }
}

void check_vtp_lines(const std::filesystem::path& path, const io::SceneSnapshot& snapshot) {
  auto arrays = read_vtp(path);
  std::vector<double> points;
  std::vector<double> distances;
  std::vector<double> levels;
  std::vector<double> insides;
  std::vector<double> lines;
  std::vector<double> fullnesses;
  std::vector<double> extents;
  const auto add = [&](const Vector3d& from, const Vector3d& to, double distance, double level, double line) {
    append(points, from);
    append(points, to);
    distances.push_back(distance);
    levels.push_back(level);
    lines.push_back(line);
    fullnesses.push_back(0);
    extents.push_back(0);
  };
  for (const PairReport& pair : snapshot.report->pairs()) {
    add(pair.witness.point_a, pair.witness.point_b, pair.distance.upper, 0, 0);
    for (const RegionDistance& region : snapshot.report->region_distances(pair))
      add(region.point_a, region.point_b, region.distance, region.level, 1);
    const WayOut& way = pair.way_out;
    if (way.direction != Vector3d::Zero()) {
      add(way.point, way.point + way.thickness * way.direction, way.thickness, 0, 2);
      fullnesses.back() = way.fullness;
      extents.back() = way.extent;
    }
    insides.resize(levels.size(), static_cast<double>(pair.inside));
  }
  CHECK(Printed(arrays["CellData/line"]).numbers == lines);
  CHECK(Printed(arrays["CellData/fullness"]).numbers == fullnesses);
  CHECK(Printed(arrays["CellData/extent"]).numbers == extents);
  CHECK(Printed(arrays["Points/Points"]).numbers == points);
  CHECK(Printed(arrays["CellData/distance"]).numbers == distances);
  CHECK(Printed(arrays["CellData/level"]).numbers == levels);
  CHECK(Printed(arrays["CellData/inside"]).numbers == insides);
  CHECK(arrays["counts"].at(2) == std::to_string(levels.size()));
}

/// The corners of all triangles of an object, rounded to float. Quads are split from their first corner.
std::vector<Eigen::Vector3f> triangle_corners(const Mesh& mesh, const std::vector<Vector3d>& positions) {
  std::vector<Eigen::Vector3f> corners;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    for (std::size_t last = 2; last < mesh.face(face).size(); ++last)
      for (const std::size_t corner : {std::size_t{0}, last - 1, last})
        corners.push_back(positions[mesh.face(face)[corner]].cast<float>());
  return corners;
}

std::vector<Eigen::Vector3f> triangle_corners(const aiMesh& mesh) {
  std::vector<Eigen::Vector3f> corners;
  for (unsigned face = 0; face < mesh.mNumFaces; ++face)
    for (unsigned i = 0; i < mesh.mFaces[face].mNumIndices; ++i) {
      const aiVector3D& corner = mesh.mVertices[mesh.mFaces[face].mIndices[i]];
      corners.emplace_back(corner.x, corner.y, corner.z);
    }
  return corners;
}

}  // namespace

TEST_CASE("export: the tables are the reports, to the last bit and in any locale") {
  const ExportScene scene;
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaNumbers));
  io::ContactTable contacts(scene.path("contacts.csv"));
  io::DistanceTable distances(scene.path("distances.csv"));
  for (const io::SceneSnapshot& snapshot : scene.frames()) {
    contacts.write(snapshot);
    distances.write(snapshot);
  }
  contacts.close();
  distances.close();
  std::locale::global(before);
  const Rows contact_rows = read_csv(scene.path("contacts.csv"));
  const Rows distance_rows = read_csv(scene.path("distances.csv"));
  CHECK(contact_rows.at(0).size() == 29);
  CHECK(distance_rows.at(0).size() == 34);
  CHECK(contacts.row_count() + 1 == contact_rows.size());
  CHECK(distances.row_count() + 1 == distance_rows.size());
  std::size_t next_contact = 1;
  std::size_t next_row = 1;
  std::size_t sunk = 0;
  for (const io::SceneSnapshot& snapshot : scene.frames()) {
    sunk += sunk_count(*snapshot.report);
    for (const PairReport& pair : snapshot.report->pairs()) {
      check_row(Cells(distance_rows.at(next_row++)), snapshot, pair);
      for (const Contact& contact : snapshot.report->contacts(pair))
        check_contact(Cells(contact_rows.at(next_contact++)), snapshot, pair, contact);
    }
  }
  CHECK(sunk > 0);
  CHECK(next_contact == contact_rows.size());
  CHECK(next_row == distance_rows.size());
}

TEST_CASE("export: the time series has the surfaces, the contacts and the lines of each frame") {
  if (std::system("python3 -c 'import xml.etree' >/dev/null 2>&1") != 0) {
    std::cout << "skipped: there is no Python 3 to read .vtp files with\n";
    return;
  }
  const ExportScene scene;
  io::ParaviewSeries series(scene.path("run & all.pvd"));
  std::string expected;
  for (const io::SceneSnapshot& snapshot : scene.frames()) {
    if (snapshot.frame % 4 == 2) continue;
    series.write(snapshot);
    const std::filesystem::path folder = scene.path("run & all");
    const std::string number = (snapshot.frame < 10 ? "00000" : "0000") + std::to_string(snapshot.frame);
    int part = 0;
    for (const std::string name : {"surfaces_", "contacts_", "lines_"})
      expected += "<DataSet timestep=\"" + std::to_string(snapshot.frame) + "\" part=\"" +
                  std::to_string(part++) + "\" file=\"run &amp; all/" + name + number + ".vtp\"/>\n";
    if (snapshot.frame % 4 != 1) continue;
    check_vtp_surfaces(folder / ("surfaces_" + number + ".vtp"), snapshot);
    check_vtp_contacts(folder / ("contacts_" + number + ".vtp"), snapshot);
    check_vtp_lines(folder / ("lines_" + number + ".vtp"), snapshot);
  }
  series.close();
  CHECK(series.frame_count() == 9);
  CHECK_THAT(read_file(scene.path("run & all.pvd")), Catch::Matchers::Contains(expected));
}

TEST_CASE("export: surfaces far from the origin keep their shape in a glTF") {
  const ExportScene scene;
  io::SceneSnapshot snapshot = scene.frames().at(5);
  const Eigen::Vector3d far(5e6, -4e5, 100);
  for (auto& object : snapshot.objects)
    for (Eigen::Vector3d& position : object.positions) position += far;
  for (const std::string name : {"far.gltf", "far.glb"}) {
    io::write_gltf(scene.path(name), snapshot);
    const io::MeshFile file = io::MeshFile::read(scene.path(name));
    REQUIRE(file.objects().size() == snapshot.objects.size());
    for (std::size_t i = 0; i < file.objects().size(); ++i) {
      const Mesh& mesh = *file.objects()[i].mesh;
      const auto expected = snapshot.objects[i].mesh->face(0);
      const Eigen::Vector3d edge = mesh.rest()[mesh.face(0)[1]] - mesh.rest()[mesh.face(0)[0]];
      const auto& positions = snapshot.objects[i].positions;
      CHECK((edge - (positions[expected[1]] - positions[expected[0]])).norm() < 1e-6);
      CHECK((mesh.rest()[mesh.face(0)[0]] - positions[expected[0]]).norm() < 1e-6);
    }
  }
}

TEST_CASE("export: graze and assimp read the surfaces of a glTF back") {
  const ExportScene scene;
  const io::SceneSnapshot& snapshot = scene.frames().at(5);
  const std::vector<std::string> names{"sheet, \"wide\"", "spike\n2", "block"};
  for (const std::string name : {"frame.gltf", "frame.glb"}) {
    CAPTURE(name);
    io::write_gltf(scene.path(name), snapshot);
    const io::MeshFile file = io::MeshFile::read(scene.path(name));
    REQUIRE(file.objects().size() == 3);
    Assimp::Importer importer;
    const aiScene* const read = importer.ReadFile(scene.path(name).string(), 0);
    REQUIRE(read != nullptr);
    REQUIRE(read->mNumMeshes == 4);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto expected = triangle_corners(*snapshot.objects[i].mesh, snapshot.objects[i].positions);
      const Mesh& mesh = *file.objects()[i].mesh;
      CHECK(file.objects()[i].name == names[i]);
      CHECK(triangle_corners(mesh, {mesh.rest().begin(), mesh.rest().end()}) == expected);
      CHECK(triangle_corners(*read->mMeshes[i]) == expected);
    }
    const aiMesh& points = *read->mMeshes[3];
    REQUIRE(points.mPrimitiveTypes == aiPrimitiveType_POINT);
    REQUIRE(points.mNumVertices == snapshot.report->contacts().size());
    for (unsigned i = 0; i < points.mNumVertices; ++i) {
      const Contact& contact = snapshot.report->contacts()[i];
      const aiVector3D& point = points.mVertices[i];
      const aiVector3D& normal = points.mNormals[i];
      CHECK(Eigen::Vector3f(point.x, point.y, point.z) == contact.point_a.cast<float>());
      CHECK(Eigen::Vector3f(normal.x, normal.y, normal.z) == contact.normal.cast<float>());
    }
  }
}

TEST_CASE("export: what the disk does not take is an error with the path") {
  const ExportScene scene;
  const auto message = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  const auto write_table = [&](const char* path) {
    io::ContactTable table(path);
    for (const io::SceneSnapshot& snapshot : scene.frames()) table.write(snapshot);
    table.close();
  };
  CHECK_THAT(message([&] { write_table("/dev/full"); }), Catch::Matchers::Contains("/dev/full: cannot be"));
  CHECK_THAT(message([&] { write_table("/no/table.csv"); }), Catch::Matchers::Contains("/no/table.csv: "));
  CHECK_THAT(message([&] { io::write_gltf("/dev/full", scene.frames()[0]); }),
             Catch::Matchers::Contains("/dev/full: cannot be"));
  CHECK_THAT(message([&] { io::write_gltf(scene.path("none.gltf"), {}); }),
             Catch::Matchers::Contains("none.gltf: the frame has no object"));
}
