// What a page holds: a decoder of its own reads it back.

#include <graze/io/page.hpp>

#include "io/decoded_report.hpp"
#include "io/marked_report.hpp"
#include "io/page/page_comparison.hpp"
#include "io/page/page_decoder.hpp"
#include "io/page/page_play.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;
namespace io = graze::io;

TEST_CASE("page: a decoder of its own reads back every row, contact, region distance and position") {
  const TemporaryFolder folder;
  const PagePlay& scene = page_play();
  const auto file = folder / "view.html";
  io::PageWriter page(file, page_template, options_of(scene));
  write_page(scene, page);
  CHECK(page.frame_count() == scene.reports.size());
  CHECK(page.byte_count() == std::filesystem::file_size(file));
  compare_page(file, scene, 1);
}

TEST_CASE("page: the played scene has what a page must show") {
  const PagePlay& scene = page_play();
  std::size_t contacts = 0;
  std::size_t regions = 0;
  std::size_t crossing = 0;
  std::size_t sunk = 0;
  std::size_t of_self = 0;
  std::size_t impacts = 0;
  std::size_t near_on_the_way = 0;
  for (const graze::FrameReport& report : scene.reports) {
    sunk += sunk_count(report);
    impacts += report.impacts().size();
    for (const graze::PairReport& pair : report.pairs()) {
      crossing += pair.inside == graze::Inside::crossing;
      of_self += pair.a == pair.b;
      near_on_the_way += pair.time_of_gap < 1;
    }
    contacts += report.contacts().size();
    regions += report.region_distances().size();
  }
  CHECK(contacts > 100);
  CHECK(regions > 1000);
  CHECK(crossing > 10);
  CHECK(sunk > 10);
  CHECK(of_self > 10);
  CHECK(impacts > 100);
  CHECK(near_on_the_way > 10);
  CHECK(scene.reports[5].diagnostics().size() == 1);
}

TEST_CASE("page: a file of data alone has the same chunks as a page") {
  const TemporaryFolder folder;
  const PagePlay& scene = page_play();
  io::PageWriter page(folder / "view.html", page_template, options_of(scene));
  write_page(scene, page);
  io::PageWriter data(folder / "view.grazeview", {}, options_of(scene));
  write_page(scene, data);
  CHECK(read_file(folder / "view.grazeview").starts_with("GRZVIEW1"));
  CHECK(chunks_of(folder / "view.grazeview") == chunks_of(folder / "view.html"));
}

TEST_CASE("page: every third frame, also where objects come and go between these frames") {
  const TemporaryFolder folder;
  const PagePlay& scene = page_play();
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
  const PagePlay& scene = page_play();
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
  const PagePlay& scene = page_play();
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

TEST_CASE("page: a step without impacts has no bytes of them, and a page without any has no series of them") {
  const TemporaryFolder folder;
  const PagePlay& scene = page_play();
  io::PageWriter page(folder / "swept.grazeview", {}, options_of(scene));
  write_page(scene, page);
  const DecodedPage swept(folder / "swept.grazeview");
  for (std::uint64_t frame = 21; frame <= 24; ++frame) {  // nothing moves
    const DecodedReport report(swept, frame);
    for (std::size_t row = report.pair_begin(); row < report.pair_end(); ++row)
      CHECK_FALSE(report.sweep_of(row));
  }
  CHECK(swept.report(0).first->has("impact_kind"));
  io::PageWriter waves(folder / "waves.grazeview", {}, {});
  write_waves(waves, grid(3), 4);
  waves.close();
  const DecodedPage plain(folder / "waves.grazeview");
  CHECK_FALSE(plain.head().at("series").contains("impacts"));
  CHECK(plain.head().at("series").at("deepest").at(0).is_null());
  CHECK_FALSE(plain.report(0).first->has("sweep_pair"));
  CHECK_FALSE(plain.report(0).first->has("impact_kind"));
}

TEST_CASE("page: a diagnostic has the frame of the page and the index of the object") {
  const TemporaryFolder folder;
  const PagePlay& scene = page_play();
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
  const PagePlay& scene = page_play();
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
  const PagePlay& scene = page_play();
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
  const PagePlay& scene = page_play();
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
