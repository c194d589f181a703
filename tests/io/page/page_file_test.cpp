// The file of a page: how large it becomes, which frames it leaves out for that, and what happens where it
// cannot be written.

#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/page.hpp>

#include "io/page/page_decoder.hpp"
#include "io/page/page_play.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

using Eigen::Vector3d;

bool is_empty(const TemporaryFolder& folder) {
  return std::filesystem::is_empty(folder.path());
}

}  // namespace

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

TEST_CASE("page: the head has settings of objects that are not as usual") {
  const TemporaryFolder folder;
  graze::ObjectSettings settings;
  settings.layer = 4;
  settings.group = std::uint64_t{1} << 60U;
  settings.margin = 0.125;
  settings.self = true;
  settings.face_groups = {0, 3};
  settings.user_data = 7;
  io::PageWriter page(folder / "view.grazeview", {}, {});
  page.add_object({0, 1}, {.name = "usual", .mesh = grid(2)});
  page.add_object({1, 1}, {.name = "other", .mesh = grid(2), .settings = settings});
  page.frame(0, {});
  page.close();
  const nlohmann::json objects = DecodedPage(folder / "view.grazeview").head().at("objects");
  CHECK_FALSE(objects.at(0).contains("settings"));
  CHECK(objects.at(1).at("settings") == nlohmann::json{{"layer", 4},
                                                       {"group", std::uint64_t{1} << 60U},
                                                       {"margin", 0.125},
                                                       {"self", true},
                                                       {"face_groups", {0, 3}}});
}

TEST_CASE("page: calls that name no object of the page are errors") {
  const TemporaryFolder folder;
  const PagePlay& scene = page_play();
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
