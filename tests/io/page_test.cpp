#include <bit>
#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/page.hpp>
#include <map>

#include "io/marked_report.hpp"
#include "page_decoder.hpp"
#include "page_play.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

using Eigen::Vector3d;

const std::string page_template =
    "<html>\n<head></head>\n<!-- graze-data -->\n<script>play()</script>\n</html>\n";

io::PageOptions options_of(const PlayedScene& scene) {
  io::PageOptions options;
  options.title = "a </script> title";
  options.source = "scene.json";
  options.settings = scene.settings;
  return options;
}

std::uint64_t bits(double number) {
  return std::bit_cast<std::uint64_t>(number);
}

/// The report of one frame, in a block's table.
class DecodedReport {
 public:
  DecodedReport(const DecodedPage& page, std::uint64_t frame)
      : table_(*page.report(frame).first), index_(page.report(frame).second) {}

  [[nodiscard]] std::size_t pair_begin() const { return word("frame_pair_begin", index_); }
  [[nodiscard]] std::size_t pair_end() const { return word("frame_pair_end", index_); }
  [[nodiscard]] std::uint32_t word(const std::string& array, std::size_t index) const {
    return list<std::uint32_t>(words_, array).at(index);
  }
  [[nodiscard]] std::uint8_t byte(const std::string& array, std::size_t index) const {
    return list<std::uint8_t>(bytes_, array).at(index);
  }
  [[nodiscard]] std::uint64_t real_bits(const std::string& array, std::size_t index) const {
    return bits(list<double>(reals_, array).at(index));
  }
  /// The row of a pair's way out, or nothing where it has none.
  [[nodiscard]] std::optional<std::size_t> way_of(std::size_t pair) const {
    if (!table_.has("way_pair")) return std::nullopt;
    const auto& pairs = list<std::uint32_t>(words_, "way_pair");
    const auto found = std::ranges::lower_bound(pairs, pair);
    if (found == pairs.end() || *found != pair) return std::nullopt;
    return static_cast<std::size_t>(found - pairs.begin());
  }
  [[nodiscard]] const nlohmann::json& header() const { return table_.header(); }
  [[nodiscard]] std::size_t index() const { return index_; }

 private:
  template <typename Number>
  const std::vector<Number>& list(std::map<std::string, std::vector<Number>>& known,
                                  const std::string& array) const {
    const auto found = known.find(array);
    if (found != known.end()) return found->second;
    return known.emplace(array, table_.numbers<Number>(array)).first->second;
  }

  const DecodedTable& table_;
  std::size_t index_;
  mutable std::map<std::string, std::vector<std::uint32_t>> words_;
  mutable std::map<std::string, std::vector<std::uint8_t>> bytes_;
  mutable std::map<std::string, std::vector<double>> reals_;
};

/// Counts what differs, so that a failure does not print each number.
struct Differences {
  std::size_t count = 0;
  void expect(bool is_equal) { count += is_equal ? 0 : 1; }
};

void compare_point(Differences& differences, const DecodedReport& decoded, const std::string& array,
                   std::size_t first, const Vector3d& point) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    differences.expect(decoded.real_bits(array, first + axis) ==
                       bits(point[static_cast<Eigen::Index>(axis)]));
}

void compare_feature(Differences& differences, const DecodedReport& decoded, const std::string& array,
                     std::size_t first, const graze::Feature& feature) {
  differences.expect(decoded.word(array, first) == static_cast<std::uint32_t>(feature.kind));
  differences.expect(decoded.word(array, first + 1) == feature.index);
}

void compare_contact(Differences& differences, const DecodedReport& decoded, std::size_t row,
                     const graze::Contact& contact, std::uint64_t since) {
  differences.expect(decoded.byte("contact_kind", row) == static_cast<int>(contact.kind));
  differences.expect(decoded.byte("contact_sides", row) == static_cast<int>(contact.side_a) +
                                                               4 * static_cast<int>(contact.side_b) +
                                                               (contact.sunk ? 16 : 0));
  compare_feature(differences, decoded, "contact_features", 4 * row, contact.feature_a);
  compare_feature(differences, decoded, "contact_features", 4 * row + 2, contact.feature_b);
  compare_point(differences, decoded, "contact_points", 6 * row, contact.point_a);
  compare_point(differences, decoded, "contact_points", 6 * row + 3, contact.point_b);
  compare_point(differences, decoded, "contact_normal", 3 * row, contact.normal);
  differences.expect(decoded.real_bits("contact_distance", row) == bits(contact.distance));
  differences.expect(decoded.word("contact_since", row) == since);
}

void compare_region(Differences& differences, const DecodedReport& decoded, std::size_t row,
                    const graze::RegionDistance& region) {
  differences.expect(decoded.word("region_levels", row) == region.level);
  const std::array<std::uint32_t, 4> ids = {region.region_a, region.region_b, region.vertex_a,
                                            region.vertex_b};
  for (std::size_t i = 0; i < 4; ++i) differences.expect(decoded.word("region_ids", 4 * row + i) == ids[i]);
  compare_point(differences, decoded, "region_points", 6 * row, region.point_a);
  compare_point(differences, decoded, "region_points", 6 * row + 3, region.point_b);
  differences.expect(decoded.real_bits("region_distance", row) == bits(region.distance));
}

/// A pair has a row among the ways out, unless all of its own is 0.
void compare_way_out(Differences& differences, const DecodedReport& decoded, std::size_t pair,
                     const graze::WayOut& way) {
  const std::optional<std::size_t> row = decoded.way_of(pair);
  differences.expect(row.has_value() == (way.fullness != 0 || way.point != Vector3d::Zero()));
  if (!row) return;
  compare_point(differences, decoded, "way_direction", 3 * *row, way.direction);
  compare_point(differences, decoded, "way_point", 3 * *row, way.point);
  differences.expect(decoded.real_bits("way_fullness", *row) == bits(way.fullness));
  differences.expect(decoded.real_bits("way_thickness", *row) == bits(way.thickness));
  differences.expect(decoded.real_bits("way_extent", *row) == bits(way.extent));
}

std::uint32_t index_of(const PlayedScene& scene, graze::ObjectId id) {
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].id == id) return i;
  return std::numeric_limits<std::uint32_t>::max();
}

void compare_pair(Differences& differences, const DecodedReport& decoded, std::size_t row,
                  const PlayedScene& scene, const graze::FrameReport& report, const graze::PairReport& pair) {
  differences.expect(decoded.word("pair_a", row) == index_of(scene, pair.a));
  differences.expect(decoded.word("pair_b", row) == index_of(scene, pair.b));
  differences.expect(decoded.byte("pair_phase", row) == static_cast<int>(pair.phase));
  const int flags = (pair.complete ? 0 : 1) + (pair.stale ? 2 : 0) + (pair.contacts_cut ? 4 : 0);
  differences.expect(decoded.byte("pair_flags", row) == flags);
  differences.expect(decoded.byte("pair_inside", row) == static_cast<int>(pair.inside));
  differences.expect(decoded.real_bits("pair_lower", row) == bits(pair.distance.lower));
  differences.expect(decoded.real_bits("pair_upper", row) == bits(pair.distance.upper));
  compare_feature(differences, decoded, "witness_features", 4 * row, pair.witness.feature_a);
  compare_feature(differences, decoded, "witness_features", 4 * row + 2, pair.witness.feature_b);
  compare_point(differences, decoded, "witness_points", 6 * row, pair.witness.point_a);
  compare_point(differences, decoded, "witness_points", 6 * row + 3, pair.witness.point_b);
  compare_way_out(differences, decoded, row, pair.way_out);
  const std::size_t contacts = decoded.word("pair_contact_begin", row);
  REQUIRE(decoded.word("pair_contact_end", row) - contacts == pair.contact_count);
  for (std::size_t i = 0; i < pair.contact_count; ++i) {
    const graze::Contact& contact = report.contacts(pair)[i];
    compare_contact(differences, decoded, contacts + i, contact, source_number(contact.since - 1));
  }
  const std::size_t regions = decoded.word("pair_region_begin", row);
  REQUIRE(decoded.word("pair_region_end", row) - regions == pair.region_distance_count);
  for (std::size_t i = 0; i < pair.region_distance_count; ++i)
    compare_region(differences, decoded, regions + i, report.region_distances(pair)[i]);
}

void compare_reports(const DecodedPage& page, const PlayedScene& scene, std::uint64_t every) {
  Differences differences;
  for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame) {
    const graze::FrameReport& report = scene.reports[static_cast<std::size_t>(frame * every)];
    const DecodedReport decoded(page, frame);
    REQUIRE(decoded.pair_end() - decoded.pair_begin() == report.pairs().size());
    for (std::size_t i = 0; i < report.pairs().size(); ++i)
      compare_pair(differences, decoded, decoded.pair_begin() + i, scene, report, report.pairs()[i]);
    const nlohmann::json& info = decoded.header().at("frames_info").at(decoded.index());
    differences.expect(info.at("frame") == source_number(frame * every));
    differences.expect(info.at("tag") == std::to_string(3 * frame * every));
    differences.expect(info.at("complete") == report.complete());
    differences.expect(info.at("statistics").at("contacts") == report.statistics().contacts);
  }
  CHECK(differences.count == 0);
}

/// Whether a shape is drawn as it was played.
void compare_shape(Differences& differences, const DecodedShape& shape, const PlayedObject& object,
                   std::size_t index, double error) {
  if (object.page.motion != graze::Motion::deformable) {
    for (std::size_t i = 0; i < 12; ++i)
      differences.expect(bits(shape.pose[i]) == bits(object.poses[index][i]));
    return;
  }
  const std::vector<Vector3d>& points = object.positions[index];
  REQUIRE(shape.positions.size() == points.size());
  for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex) {
    const bool is_drawn = object.page.mesh->is_used(vertex) && points[vertex].allFinite();
    const auto& drawn = shape.positions[vertex];
    differences.expect(drawn.has_value() == is_drawn);
    if (drawn && is_drawn) differences.expect((*drawn - points[vertex]).cwiseAbs().maxCoeff() <= error);
  }
}

void compare_motion(const DecodedPage& page, const PlayedScene& scene, std::uint64_t every) {
  Differences differences;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const PlayedObject& object = scene.objects[i];
    const nlohmann::json& described = page.head().at("objects").at(i);
    const double error = described.at("position_error");
    if (object.page.motion == graze::Motion::deformable)
      CHECK(error <= std::ldexp(1.3, -16));  // the cloth is 1.2 wide; its waves are less high
    else
      CHECK(error == 0);
    for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame) {
      const std::uint64_t played = frame * every;
      const bool exists = played >= object.added && (!object.removed || played < *object.removed);
      const auto signed_frame = static_cast<std::int64_t>(frame);
      differences.expect(exists == (described.at("first").get<std::int64_t>() <= signed_frame &&
                                    signed_frame <= described.at("last").get<std::int64_t>()));
      const auto shape = page.shape(i, frame);
      if (!exists) continue;
      REQUIRE(shape);
      compare_shape(differences, *shape, object, static_cast<std::size_t>(played - object.added), error);
    }
  }
  CHECK(differences.count == 0);
}

void compare_head(const DecodedPage& page, const PlayedScene& scene, std::uint64_t every) {
  const nlohmann::json& head = page.head();
  CHECK(head.at("version") == 2);
  CHECK(head.at("title") == "a </script> title");
  CHECK(head.at("source") == "scene.json");
  CHECK(head.at("settings").at("contact_distance") == 0.03);
  CHECK(head.at("settings").at("range") == "infinity");
  CHECK(head.at("every") == every);
  CHECK(head.at("source_frames") == scene.reports.size());
  REQUIRE(head.at("frames") == (scene.reports.size() + every - 1) / every);
  for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame)
    CHECK(head.at("frame_numbers").at(frame) == source_number(frame * every));
  CHECK(head.at("diverged").at(0) == (10 + every - 1) / every);
  // 11 frames are missing before frame 11, 12 before frame 12, and 3 at the end.
  std::map<std::uint64_t, std::uint64_t> dropped;
  dropped[(11 + every - 1) / every] += 11;
  dropped[(12 + every - 1) / every] += 12;
  dropped[page.frame_count()] += 3;
  nlohmann::json pairs = nlohmann::json::array();
  for (const auto& [before, count] : dropped) pairs.push_back({before, count});
  CHECK(head.at("dropped") == pairs);
  REQUIRE(head.at("objects").size() == scene.objects.size());
  CHECK(head.at("objects").at(0).at("name") == "cloth </script><b>\"");
  CHECK(head.at("objects").at(1).at("user_data") == "9223372036854775808");
  CHECK(head.at("objects").at(2).at("motion") == "fixed");
  CHECK(head.at("objects").at(0).at("solid") == false);
  CHECK(head.at("objects").at(2).at("solid") == true);
  CHECK(head.at("meshes").size() == 2);
}

void compare_series(const DecodedPage& page, const PlayedScene& scene, std::uint64_t every) {
  const nlohmann::json& series = page.head().at("series");
  for (std::uint64_t frame = 0; frame < page.frame_count(); ++frame) {
    const graze::FrameReport& report = scene.reports[static_cast<std::size_t>(frame * every)];
    std::size_t ended = 0;
    std::size_t crossing = 0;
    for (const graze::PairReport& pair : report.pairs()) {
      ended += pair.phase == graze::PairPhase::ended;
      crossing += pair.inside == graze::Inside::crossing;
    }
    CHECK(series.at("contacts").at(frame) == report.contacts().size());
    CHECK(series.at("near").at(frame) == report.pairs().size());
    CHECK(series.at("ended").at(frame) == ended);
    CHECK(series.at("crossing").at(frame) == crossing);
    CHECK(series.at("inside").at(frame) == 0);
    CHECK(series.at("diagnostics").at(frame) == report.diagnostics().size());
    CHECK(series.at("step_ms").at(frame) == report.statistics().step_ms);
  }
}

void compare_page(const std::filesystem::path& file, const PlayedScene& scene, std::uint64_t every) {
  const DecodedPage page(file);
  compare_head(page, scene, every);
  compare_series(page, scene, every);
  compare_reports(page, scene, every);
  compare_motion(page, scene, every);
}

std::shared_ptr<const graze::Mesh> grid(std::uint32_t side) {
  std::vector<Vector3d> points;
  std::vector<std::array<std::uint32_t, 4>> quads;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) points.emplace_back(x, y, 0.0);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * (side + 1) + x;
      quads.push_back({a, a + 1, a + side + 2, a + side + 1});
    }
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_quads(points, quads));
}

/// Writes `frames` frames of a waving grid, without reports.
void write_waves(io::PageWriter& page, const std::shared_ptr<const graze::Mesh>& mesh, std::uint64_t frames) {
  const graze::ObjectId id{0, 1};
  page.add_object(id, {"waves", mesh, graze::Motion::deformable, 0});
  std::vector<Vector3d> points(mesh->rest().begin(), mesh->rest().end());
  for (std::uint64_t frame = 0; frame < frames; ++frame) {
    for (Vector3d& point : points)
      point.z() = std::sin(0.3 * point.x() + 0.1 * static_cast<double>(frame)) * std::cos(point.y());
    page.set_positions(id, points);
    page.frame(frame, {});
  }
}

bool is_empty(const TemporaryFolder& folder) {
  return std::filesystem::is_empty(folder.path());
}

}  // namespace

TEST_CASE("page: a decoder of its own reads back every row, contact, region distance and position") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  const auto file = folder / "view.html";
  io::PageWriter page(file, page_template, options_of(scene));
  write_page(scene, page);
  CHECK(page.frame_count() == scene.reports.size());
  CHECK(page.byte_count() == std::filesystem::file_size(file));
  compare_page(file, scene, 1);
}

TEST_CASE("page: the played scene has what a page must show") {
  const PlayedScene& scene = played_scene();
  std::size_t contacts = 0;
  std::size_t regions = 0;
  std::size_t crossing = 0;
  std::size_t sunk = 0;
  for (const graze::FrameReport& report : scene.reports) {
    sunk += sunk_count(report);
    for (const graze::PairReport& pair : report.pairs()) crossing += pair.inside == graze::Inside::crossing;
    contacts += report.contacts().size();
    regions += report.region_distances().size();
  }
  CHECK(contacts > 100);
  CHECK(regions > 1000);
  CHECK(crossing > 10);
  CHECK(sunk > 10);
  CHECK(scene.reports[5].diagnostics().size() == 1);
}

TEST_CASE("page: a file of data alone has the same chunks as a page") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageWriter page(folder / "view.html", page_template, options_of(scene));
  write_page(scene, page);
  io::PageWriter data(folder / "view.grazeview", {}, options_of(scene));
  write_page(scene, data);
  CHECK(read_file(folder / "view.grazeview").starts_with("GRZVIEW1"));
  CHECK(chunks_of(folder / "view.grazeview") == chunks_of(folder / "view.html"));
}

TEST_CASE("page: every third frame, also where objects come and go between these frames") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageOptions options = options_of(scene);
  options.every = 3;
  io::PageWriter page(folder / "view.grazeview", {}, options);
  CHECK(page.takes_next_frame());
  write_page(scene, page);
  compare_page(folder / "view.grazeview", scene, 3);
}

TEST_CASE("page: an object that is there in no frame of the page") {
  const TemporaryFolder folder;
  io::PageOptions options;
  options.every = 4;
  io::PageWriter page(folder / "view.grazeview", {}, options);
  page.frame(0, {});
  page.add_object({5, 1}, {"short", grid(2), graze::Motion::deformable, 0});
  page.set_positions({5, 1}, grid(2)->rest());
  page.frame(1, {});
  page.remove_object({5, 1});
  for (std::uint64_t frame = 2; frame < 6; ++frame) page.frame(frame, {});
  page.close();
  const DecodedPage decoded(folder / "view.grazeview");
  CHECK(decoded.head().at("objects").at(0).at("first") == 1);
  CHECK(decoded.head().at("objects").at(0).at("last") == 0);
  CHECK(!decoded.shape(0, 1));
}

TEST_CASE("page: an object with another mesh is another object of the page, also within a block") {
  const TemporaryFolder folder;
  graze::SceneSettings settings;
  settings.range = 10;
  graze::Scene scene(settings);
  const auto coarse = grid(2);
  const auto fine = grid(3);
  const graze::ObjectId floor = scene.add(coarse);
  const graze::ObjectId lid = scene.add(coarse);
  io::PageWriter page(folder / "view.grazeview", {}, {});
  page.add_object(floor, {"floor", coarse, graze::Motion::deformable, 0});
  page.add_object(lid, {"lid", coarse, graze::Motion::deformable, 0});
  page.frame(0, *scene.step());
  scene.replace_mesh(floor, fine, std::vector<std::uint32_t>(9, graze::Mesh::no_vertex));
  page.remove_object(floor);
  page.add_object(floor, {"floor", fine, graze::Motion::deformable, 0});
  page.frame(1, *scene.step());
  page.close();
  const DecodedPage decoded(folder / "view.grazeview");
  CHECK(decoded.block() == 2);
  REQUIRE(decoded.head().at("objects").size() == 3);
  CHECK(decoded.head().at("objects").at(0).at("last") == 0);
  CHECK(decoded.head().at("objects").at(2).at("first") == 1);
  CHECK(decoded.shape(2, 1).value().positions.size() == 16);
  for (std::uint64_t frame = 0; frame < 2; ++frame) {
    const DecodedReport report(decoded, frame);
    REQUIRE(report.pair_end() - report.pair_begin() == 1);
    CHECK(report.word("pair_a", report.pair_begin()) == 2 * frame);
    CHECK(report.word("pair_b", report.pair_begin()) == 1);
  }
}

TEST_CASE("page: frames that did not change share their rows, and take no positions") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageWriter page(folder / "view.grazeview", {}, options_of(scene));
  write_page(scene, page);
  const DecodedPage decoded(folder / "view.grazeview");
  const DecodedReport before(decoded, 22);
  const DecodedReport after(decoded, 24);
  CHECK(before.pair_begin() == after.pair_begin());
  CHECK(before.pair_end() == after.pair_end());
  CHECK(before.pair_end() > before.pair_begin());
  const auto moved = decoded.track_frames(0, 0);
  CHECK(std::ranges::count(moved, 20) == 1);
  for (std::uint64_t frame = 21; frame <= 24; ++frame) CHECK(std::ranges::count(moved, frame) == 0);
  CHECK(decoded.track_frames(2, 1) == std::vector<std::uint64_t>{32});  // fixed: once in each block
}

TEST_CASE("page: a way out has numbers in its own frame alone, and none has no bytes") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  // What a step says, once without ways out, and then with them.
  graze::FrameReport plain = scene.reports[15];
  for (const graze::PairReport& pair : plain.pairs()) const_cast<graze::PairReport&>(pair).way_out = {};
  io::PageWriter page(folder / "view.html", page_template, options_of(scene));
  for (const PlayedObject& object : scene.objects) {
    page.add_object(object.id, object.page);
    if (object.page.motion == graze::Motion::deformable)
      page.set_positions(object.id, object.positions[0]);
    else
      page.set_pose(object.id, object.poses[0]);
  }
  constexpr std::uint64_t block_frames = 32;
  for (std::uint64_t frame = 0; frame < 2 * block_frames; ++frame)
    page.frame(frame, frame == 3 ? scene.reports[15] : plain);
  page.close();
  const DecodedPage decoded(folder / "view.html");
  std::vector<std::uint64_t> frames;
  for (std::uint64_t frame = 0; frame < decoded.frame_count(); ++frame) {
    const DecodedReport report(decoded, frame);
    for (std::size_t row = report.pair_begin(); row < report.pair_end(); ++row)
      if (report.way_of(row) && (frames.empty() || frames.back() != frame)) frames.push_back(frame);
  }
  CHECK(frames == std::vector<std::uint64_t>{3});
  CHECK(decoded.report(0).first->has("way_pair"));
  REQUIRE(decoded.report(decoded.frame_count() - 1).first != decoded.report(0).first);
  CHECK_FALSE(decoded.report(decoded.frame_count() - 1).first->has("way_pair"));
}

TEST_CASE("page: a diagnostic has the frame of the page and the index of the object") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageWriter page(folder / "view.grazeview", {}, options_of(scene));
  write_page(scene, page);
  const DecodedPage decoded(folder / "view.grazeview");
  const nlohmann::json& diagnostics = DecodedReport(decoded, 0).header().at("diagnostics");
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics[0].at("frame") == 5);
  CHECK(diagnostics[0].at("object") == 0);
  CHECK(diagnostics[0].at("kind") == "not_finite");
  CHECK(!diagnostics[0].at("message").get<std::string>().empty());
}

TEST_CASE("page: faces, edges and regions of a mesh") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageWriter page(folder / "view.grazeview", {}, options_of(scene));
  write_page(scene, page);
  const DecodedPage decoded(folder / "view.grazeview");
  const graze::Mesh& mesh = *scene.objects[0].page.mesh;
  const DecodedTable& table = decoded.mesh(0);
  const auto triangles = table.numbers<std::uint32_t>("triangles");
  const auto quads = table.numbers<std::uint32_t>("quads");
  const auto order = table.numbers<std::uint32_t>("face_order");
  REQUIRE(order.size() == mesh.face_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const auto corners = mesh.face(face);
    const std::size_t before = triangles.size() / 3;
    const bool is_triangle = order[face] < before;
    REQUIRE(is_triangle == (corners.size() == 3));
    const std::uint32_t* const drawn =
        is_triangle ? &triangles.at(3 * order[face]) : &quads.at(4 * (order[face] - before));
    CHECK(std::equal(corners.begin(), corners.end(), drawn));
  }
  const auto edges = table.numbers<std::uint32_t>("edges");
  REQUIRE(edges.size() == 2 * std::size_t{mesh.edge_count()});
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge)
    CHECK(mesh.edge(edge) == std::array<std::uint32_t, 2>{edges[2 * edge], edges[2 * edge + 1]});
  CHECK(!decoded.mesh(1).has("face_order"));
  CHECK(table.numbers<double>("rest").size() == 3 * std::size_t{mesh.vertex_count()});
}

TEST_CASE("page: the regions of a mesh have their middle vertices, and children lie inside their parents") {
  const TemporaryFolder folder;
  io::PageWriter page(folder / "view.grazeview", {}, {});
  page.add_object({0, 1}, {"grid", grid(30), graze::Motion::deformable, 0});
  page.close();
  const DecodedPage decoded(folder / "view.grazeview");
  CHECK(decoded.frame_count() == 0);
  const DecodedTable& table = decoded.mesh(0);
  const auto levels = table.numbers<std::uint8_t>("region_level");
  const auto parents = table.numbers<std::uint32_t>("region_parent");
  const auto middles = table.numbers<std::uint32_t>("region_middle");
  const auto begins = table.numbers<std::uint32_t>("region_begin");
  const auto ends = table.numbers<std::uint32_t>("region_end");
  const auto vertices = table.numbers<std::uint32_t>("region_vertices");
  CHECK(vertices.size() == 31 * 31);
  CHECK(ends[0] - begins[0] == 31 * 31);
  REQUIRE(levels.size() > 20);
  for (std::size_t region = 0; region < levels.size(); ++region) {
    const auto first = vertices.begin() + begins[region];
    CHECK(std::count(first, vertices.begin() + ends[region], middles[region]) == 1);
    if (region == 0) continue;
    CHECK(levels[region] == levels[parents[region]] + 1);
    CHECK(begins[parents[region]] <= begins[region]);
    CHECK(ends[region] <= ends[parents[region]]);
  }
}

TEST_CASE("page: no name breaks the page, which keeps its template") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageWriter page(folder / "view.html", page_template, options_of(scene));
  write_page(scene, page);
  const std::string text = read_file(folder / "view.html");
  CHECK(text.starts_with("<html>\n<head></head>\n<script"));
  CHECK(text.ends_with("</script>\n\n<script>play()</script>\n</html>\n"));
  std::size_t elements = 0;
  for (std::size_t at = text.find("<script"); at != std::string::npos; at = text.find("<script", at + 1))
    ++elements;
  CHECK(elements == chunks_of(folder / "view.html").size() + 1);
  CHECK(text.find("<b>") == std::string::npos);
}

TEST_CASE("page: without times equal answers are equal files") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageOptions options = options_of(scene);
  options.include_times = false;
  for (const char* const name : {"a.grazeview", "b.grazeview"}) {
    io::PageWriter page(folder / name, {}, options);
    write_page(scene, page);
  }
  CHECK(read_file(folder / "a.grazeview") == read_file(folder / "b.grazeview"));
  const DecodedPage decoded(folder / "a.grazeview");
  CHECK(decoded.head().at("series").at("step_ms").at(3) == 0);
}

TEST_CASE("page: a block of large objects has fewer frames") {
  const TemporaryFolder folder;
  io::PageWriter page(folder / "view.grazeview", {}, {});
  write_waves(page, grid(200), 20);
  page.close();
  const DecodedPage decoded(folder / "view.grazeview");
  CHECK(decoded.frame_count() == 20);
  CHECK(decoded.block() == 9);  // of 40,401 vertices of 12 bytes, 4 MiB in all
  REQUIRE(decoded.shape(0, 19));
}

TEST_CASE("page: it takes fewer frames where it would become too large") {
  const TemporaryFolder folder;
  io::PageOptions options;
  options.expected_frames = 200;
  {
    io::PageWriter page(folder / "all.grazeview", {}, options);
    write_waves(page, grid(60), 200);
    CHECK(page.every() == 1);
    page.close();
    const auto size = static_cast<double>(page.byte_count());
    CHECK(std::abs(static_cast<double>(page.estimated_bytes()) - size) < 0.2 * size);
    options.max_bytes = page.byte_count() / 4;
  }
  io::PageWriter page(folder / "few.grazeview", {}, options);
  write_waves(page, grid(60), 200);
  page.close();
  CHECK(page.every() >= 4);
  CHECK(page.estimated_bytes() > *options.max_bytes);
  CHECK(page.byte_count() < 5 * *options.max_bytes / 4);
  const DecodedPage all(folder / "all.grazeview");
  const DecodedPage few(folder / "few.grazeview");
  CHECK(few.head().at("every") == page.every());
  REQUIRE(few.frame_count() == (199 + page.every()) / page.every());
  for (std::uint64_t frame = 0; frame < few.frame_count(); ++frame) {
    CHECK(few.head().at("frame_numbers").at(frame) == frame * page.every());
    const auto a = few.shape(0, frame);
    const auto b = all.shape(0, frame * page.every());
    REQUIRE(a);
    REQUIRE(b);
    CHECK((*a->positions[33] - *b->positions[33]).norm() < 0.01);
  }
}

TEST_CASE("page: an object that moved in frames that are left out is drawn where it went") {
  const TemporaryFolder folder;
  io::PageOptions options;
  options.expected_frames = 1000;
  options.max_bytes = 1;  // so every frame but the first is left out
  io::PageWriter page(folder / "view.grazeview", {}, options);
  const graze::ObjectId id{3, 1};
  page.add_object(id, {"box", grid(2), graze::Motion::rigid, 0});
  for (std::uint64_t frame = 0; frame <= 1200; ++frame) {
    if (frame == 31) page.set_pose(id, Eigen::Isometry3d(Eigen::Translation3d(5, 6, 7)));
    page.frame(frame, {});
  }
  page.close();
  const DecodedPage decoded(folder / "view.grazeview");
  REQUIRE(decoded.frame_count() >= 2);
  CHECK(decoded.shape(0, 0)->pose[3] == 0);
  CHECK(decoded.shape(0, decoded.frame_count() - 1)->pose[3] == 5);
}

TEST_CASE("page: coordinates far apart, huge, or in one point") {
  const TemporaryFolder folder;
  io::PageWriter page(folder / "view.grazeview", {}, {});
  const auto mesh = grid(3);
  const graze::ObjectId id{0, 1};
  page.add_object(id, {"grid", mesh, graze::Motion::deformable, 0});
  std::vector<std::vector<Vector3d>> frames(4, {mesh->rest().begin(), mesh->rest().end()});
  for (Vector3d& point : frames[1]) point += Vector3d(1e9, -1e9, 0);
  frames[2][4].x() = 1e300;
  frames[3].assign(frames[3].size(), Vector3d(0.1, 0.2, 0.3));
  for (std::uint64_t frame = 0; frame < frames.size(); ++frame) {
    page.set_positions(id, frames[static_cast<std::size_t>(frame)]);
    page.frame(frame, {});
  }
  page.close();
  const DecodedPage decoded(folder / "view.grazeview");
  const double error = decoded.head().at("objects").at(0).at("position_error");
  CHECK(error < 1);  // of 2e9
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const auto shape = decoded.shape(0, frame);
    REQUIRE(shape);
    for (std::size_t vertex = 0; vertex < frames[frame].size(); ++vertex) {
      if (frame == 2 && vertex == 4)
        CHECK(!shape->positions[vertex]);
      else
        CHECK((*shape->positions[vertex] - frames[frame][vertex]).cwiseAbs().maxCoeff() <= error);
    }
  }
}

TEST_CASE("page: a file that cannot be written is an error") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(io::PageWriter(folder / "none" / "view.html", page_template, {}), io::InputError);
  CHECK_THROWS_AS(io::PageWriter(folder / "view.html", "<html></html>", {}), graze::Error);
  io::PageOptions options;
  options.every = 0;
  CHECK_THROWS_AS(io::PageWriter(folder / "view.html", page_template, options), graze::Error);
  CHECK(is_empty(folder));
}

TEST_CASE("page: a full disk is an error, and leaves no half of a page") {
  if (!std::filesystem::exists("/dev/full")) {
    std::puts("skipped: there is no /dev/full");
    return;
  }
  io::PageWriter page("/dev/full", {}, {});
  const auto write_all = [&page] {
    write_waves(page, grid(60), 40);
    page.close();
  };
  CHECK_THROWS_AS(write_all(), io::InputError);
}

TEST_CASE("page: a writer that is not closed leaves what was there") {
  const TemporaryFolder folder;
  const auto file = folder.write("view.html", "before");
  {
    io::PageWriter page(file, page_template, {});
    write_waves(page, grid(10), 40);
    CHECK(read_file(file) == "before");
    CHECK(std::filesystem::exists(folder / "view.html.part"));
  }
  CHECK(read_file(file) == "before");
  CHECK(!std::filesystem::exists(folder / "view.html.part"));
}

TEST_CASE("page: a link stays a link") {
  const TemporaryFolder folder;
  const auto file = folder.write("target.html", "before");
  std::filesystem::create_symlink(file, folder / "link.html");
  io::PageWriter page(folder / "link.html", page_template, {});
  page.close();
  CHECK(std::filesystem::is_symlink(folder / "link.html"));
  CHECK(read_file(file).starts_with("<html>"));
}

TEST_CASE("page: calls that name no object of the page are errors") {
  const TemporaryFolder folder;
  const PlayedScene& scene = played_scene();
  io::PageWriter page(folder / "view.grazeview", {}, {});
  const auto mesh = grid(2);
  const graze::ObjectId soft{0, 1};
  const graze::ObjectId hard{1, 1};
  page.add_object(soft, {"soft", mesh, graze::Motion::deformable, 0});
  page.add_object(hard, {"hard", mesh, graze::Motion::fixed, 0});
  CHECK_THROWS_AS(page.add_object(soft, {"soft", mesh, graze::Motion::deformable, 0}), graze::Error);
  CHECK_THROWS_AS(page.add_object({2, 1}, {"none", nullptr, graze::Motion::deformable, 0}), graze::Error);
  CHECK_THROWS_AS(page.set_positions(soft, std::vector<Vector3d>(3, Vector3d::Zero())), graze::Error);
  CHECK_THROWS_AS(page.set_positions(hard, mesh->rest()), graze::Error);
  CHECK_THROWS_AS(page.set_pose(soft, Eigen::Isometry3d::Identity()), graze::Error);
  CHECK_THROWS_AS(page.set_pose({7, 1}, Eigen::Isometry3d::Identity()), graze::Error);
  CHECK_THROWS_AS(page.frame(0, scene.reports[0]), graze::Error);
  page.remove_object(hard);
  CHECK_THROWS_AS(page.remove_object(hard), graze::Error);
  page.close();
}
