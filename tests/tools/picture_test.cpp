#include <png.h>

#include <array>
#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/picture.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Eigen::Vector3d;
using graze::io::PictureScene;
using graze::io::PictureSettings;
using graze::tests::TemporaryFolder;

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  [[nodiscard]] std::array<int, 3> at(int x, int y) const {
    const auto first = 3 * static_cast<std::size_t>(y * width + x);
    return {rgb[first], rgb[first + 1], rgb[first + 2]};
  }
};

Image read_png(const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&header, path.string().c_str()) != 0);
  header.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  REQUIRE(png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr) != 0);
  return image;
}

/// Straight along +y, so that x is to the right and z up.
PictureSettings from_the_front() {
  return {.width = 200, .height = 100, .supersampling = 2, .to_camera = {0, -1, 0}};
}

Image draw(const PictureScene& scene) {
  const TemporaryFolder folder;
  write_picture(folder / "p.png", scene, from_the_front());
  return read_png(folder / "p.png");
}

/// An upright square of half the side `half` about `centre`, facing the front.
PictureScene::Object square(const Vector3d& centre, double half) {
  std::vector<Vector3d> points;
  for (const auto& [x, z] : std::vector<std::pair<int, int>>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    points.push_back(centre + half * Vector3d(x, 0, z));
  const std::vector<std::array<std::uint32_t, 4>> faces = {{0, 1, 2, 3}};
  return {std::make_shared<const graze::Mesh>(graze::Mesh::from_quads(points, faces)), points};
}

// The first object is blue, the second orange. Floor, sky and shadows are grey to light blue.
bool is_blue(const std::array<int, 3>& c) {
  return c[2] > c[0] + 50;
}
bool is_orange(const std::array<int, 3>& c) {
  return c[0] > c[2] + 50;
}
bool is_red(const std::array<int, 3>& c) {
  return c[0] > 200 && c[1] < 100;
}

bool is_purple(const std::array<int, 3>& c) {
  return c[0] > c[1] + 60 && c[2] > c[1] + 60;
}

int count(const Image& image, bool (*matches)(const std::array<int, 3>&)) {
  int found = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) found += matches(image.at(x, y)) ? 1 : 0;
  return found;
}

}  // namespace

TEST_CASE("a picture frames its object") {
  const Image image = draw({.objects = {square({100, 7, -40}, 3)}});
  REQUIRE((image.width == 200 && image.height == 100));
  int first_row = 1000, last_row = -1, first_column = 1000, last_column = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (is_blue(image.at(x, y))) {
        first_row = std::min(first_row, y);
        last_row = std::max(last_row, y);
        first_column = std::min(first_column, x);
        last_column = std::max(last_column, x);
      }
  const int rows = last_row - first_row + 1;
  CHECK((rows >= 80 && rows <= 95));                              // the height decides, with a margin
  CHECK(std::abs(rows - (last_column - first_column + 1)) <= 1);  // a square stays one
  CHECK(std::abs(first_row + last_row - 99) <= 1);                // in the middle
  CHECK(std::abs(first_column + last_column - 199) <= 1);
  CHECK(std::abs(count(image, is_blue) - rows * rows) <= 2 * rows);  // filled
}

TEST_CASE("what is nearer hides what is behind it, whatever the order") {
  const auto small_in_front = draw({.objects = {square({0, 0, 0}, 3), square({0, -1, 0}, 1)}});
  CHECK(is_orange(small_in_front.at(100, 50)));
  CHECK(is_blue(small_in_front.at(75, 50)));
  const auto small_behind = draw({.objects = {square({0, 0, 0}, 3), square({0, 1, 0}, 1)}});
  CHECK(count(small_behind, is_orange) == 0);
}

TEST_CASE("contacts and distances are marked where they are") {
  PictureScene scene{.objects = {square({0, 0, 0}, 3)}};
  CHECK(count(draw(scene), is_red) == 0);
  graze::Contact contact;
  contact.point_b = {0, -0.01, 0};
  contact.normal = {1, 0, 0};
  scene.contacts.push_back(contact);
  const Image image = draw(scene);
  CHECK(is_red(image.at(100, 50)));
  CHECK((count(image, is_red) > 4 && count(image, is_red) < 60));
  scene.contacts.clear();
  scene.distances.push_back({Vector3d(-2, -0.01, 0), Vector3d(2, -0.01, 0)});
  const Image without = draw({.objects = {square({0, 0, 0}, 3)}});
  const Image with_line = draw(scene);
  for (const int x : {80, 90, 100, 110, 120}) CHECK(with_line.at(x, 50) != without.at(x, 50));
  CHECK(with_line.at(100, 30) == without.at(100, 30));
}

TEST_CASE(
    "a way out is an arrow from its point along its direction, as long as it is thick, and never too short "
    "to be seen") {
  PictureScene scene{.objects = {square({0, 0, 0}, 3)}};
  const Image without = draw(scene);
  CHECK(count(without, is_purple) == 0);
  // How far the arrow reaches to the right and to the left of the middle, in pixels. 6 units are about 90.
  const auto reach = [&](const graze::WayOut& way) {
    scene.ways_out = {way};
    const Image image = draw(scene);
    int right = -1;
    int left = -1;
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, 50) != without.at(x, 50)) (x > 100 ? right : left) = std::abs(x - 100);
    return std::array{left, right, count(image, is_purple)};
  };
  const auto [left, right, purple] = reach({{1, 0, 0}, {0, -0.01, 0}, 1, 2, 4});
  CHECK((left < 4 && right > 26 && right < 36 && purple > 60));
  const auto [thin_left, thin_right, thin_purple] = reach({{1, 0, 0}, {0, -0.01, 0}, 1, 1e-9, 4});
  CHECK((thin_left < 4 && thin_right > 5 && thin_right < 20 && thin_purple > 10));
  CHECK(reach({Vector3d::Zero(), {0, -0.01, 0}, 0.05, 0, 0}) == std::array{-1, -1, 0});
}

TEST_CASE("faces that are not finite are left out; a scene of nothing else is refused") {
  PictureScene scene{.objects = {square({0, 0, 0}, 3), square({0, -1, 0}, 1)}};
  scene.objects[1].positions[2].x() = std::nan("");
  CHECK(count(draw(scene), is_orange) == 0);
  scene.objects.erase(scene.objects.begin());
  CHECK_THROWS_AS(draw(scene), graze::io::InputError);
  const TemporaryFolder folder;
  CHECK_THROWS_AS(
      write_picture(folder / "none" / "p.png", {.objects = {square({0, 0, 0}, 3)}}, from_the_front()),
      graze::io::InputError);
}
