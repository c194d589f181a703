#include "io/page/page_play.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "io/marked_report.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t frame_count = 75;
constexpr std::uint32_t cloth_side = 12;

/// A square of quads and triangles by turns, and a vertex that no face uses.
std::shared_ptr<const Mesh> cloth() {
  std::vector<Vector3d> points;
  for (std::uint32_t y = 0; y <= cloth_side; ++y)
    for (std::uint32_t x = 0; x <= cloth_side; ++x) points.emplace_back(0.1 * x - 0.6, 0.1 * y - 0.6, 0.0);
  points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 1e300, 0.0);
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> counts;
  for (std::uint32_t y = 0; y < cloth_side; ++y)
    for (std::uint32_t x = 0; x < cloth_side; ++x) {
      const std::uint32_t a = y * (cloth_side + 1) + x;
      const std::uint32_t b = a + 1;
      const std::uint32_t c = b + cloth_side + 1;
      const std::uint32_t d = a + cloth_side + 1;
      const bool is_quad = (x + y) % 2 == 0;
      const std::vector<std::uint32_t> more =
          is_quad ? std::vector<std::uint32_t>{a, b, c, d} : std::vector<std::uint32_t>{a, b, c, a, c, d};
      corners.insert(corners.end(), more.begin(), more.end());
      counts.insert(counts.end(), is_quad ? 1 : 2, is_quad ? 4 : 3);
    }
  return std::make_shared<const Mesh>(Mesh::from_polygons(points, corners, counts));
}

std::shared_ptr<const Mesh> box() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back((i & 1) != 0 ? 0.2 : -0.2, (i & 2) != 0 ? 0.2 : -0.2, (i & 4) != 0 ? 0.2 : -0.2);
  const std::vector<std::array<std::uint32_t, 4>> quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return std::make_shared<const Mesh>(Mesh::from_quads(points, quads));
}

/// Frames 20 to 24 are the same moment.
double moment_of(std::uint64_t frame) {
  return static_cast<double>(frame < 20 ? frame : std::max<std::uint64_t>(frame, 24) - 4);
}

std::vector<Vector3d> cloth_at(const Mesh& mesh, std::uint64_t frame, double height) {
  std::vector<Vector3d> points(mesh.rest().begin(), mesh.rest().end());
  const double moment = moment_of(frame);
  for (Vector3d& point : points)
    point.z() = height + 0.15 * std::sin(5 * point.x() + 0.3 * moment) * std::cos(4 * point.y());
  if (frame == 5) points[17].y() = std::numeric_limits<double>::quiet_NaN();
  return points;
}

std::array<double, 12> rows_of(const Eigen::Isometry3d& pose) {
  std::array<double, 12> rows;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      rows[static_cast<std::size_t>(4 * row + column)] = pose.matrix()(row, column);
  return rows;
}

Eigen::Isometry3d box_at(double moment) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.1 * moment, Vector3d(1, 2, 3).normalized()));
  pose.translation() = Vector3d(0.3 * std::sin(0.2 * moment), 0.1, 0.2 * std::cos(0.1 * moment));
  return pose;
}

PlayedObject& add(PagePlay& played, Scene& scene, io::PageObject object, std::uint64_t frame) {
  PlayedObject added;
  object.swept = object.motion == Motion::rigid;
  added.id = scene.add(object.mesh, {.name = object.name,
                                     .motion = object.motion,
                                     .solid = object.solid,
                                     .user_data = object.user_data,
                                     .self = object.motion == Motion::deformable,
                                     .swept = object.swept});
  added.page = std::move(object);
  added.added = frame;
  played.objects.push_back(std::move(added));
  return played.objects.back();
}

void move_objects(PagePlay& played, Scene& scene, std::uint64_t frame) {
  for (std::size_t i = 0; i < played.objects.size(); ++i) {
    PlayedObject& object = played.objects[i];
    if (object.removed) continue;
    if (object.page.motion == Motion::deformable) {
      object.positions.push_back(cloth_at(*object.page.mesh, frame, i == 0 ? 0.0 : 0.1));
      scene.set_positions(object.id, object.positions.back());
    } else {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      if (object.page.motion == Motion::rigid) pose = box_at(moment_of(frame) + static_cast<double>(i));
      object.poses.push_back(rows_of(pose));
      scene.set_pose(object.id, pose);
    }
  }
}

PagePlay play() {
  PagePlay played;
  played.settings.contact_distance = 0.03;
  played.settings.range = std::numeric_limits<double>::infinity();
  played.settings.region_distances = 60;
  played.settings.swept_gap = 0.02;
  played.settings.threads = 1;
  Scene scene(played.settings);
  const auto cloth_mesh = cloth();
  const auto box_mesh = box();
  add(played, scene, {"cloth </script><b>\"", cloth_mesh, Motion::deformable, 7}, 0);
  add(played, scene, {"box", box_mesh, Motion::rigid, std::uint64_t{1} << 63U}, 0);
  add(played, scene, {"stand", box_mesh, Motion::fixed, 0, true}, 0);
  for (std::uint64_t frame = 0; frame < frame_count; ++frame) {
    if (frame == 7) add(played, scene, {"late \xff cloth", cloth_mesh, Motion::deformable, 1}, frame);
    if (frame == 40) {
      played.objects[1].removed = frame;
      scene.remove(played.objects[1].id);
    }
    move_objects(played, scene, frame);
    played.reports.push_back(marked_report(*scene.step(3 * frame)));
  }
  return played;
}

}  // namespace

const PagePlay& page_play() {
  static const PagePlay scene = play();
  return scene;
}

void write_page(const PagePlay& scene, io::PageWriter& page) {
  for (std::uint64_t frame = 0; frame < scene.reports.size(); ++frame) {
    for (const PlayedObject& object : scene.objects) {
      if (object.added == frame) page.add_object(object.id, object.page);
      if (object.removed == frame) page.remove_object(object.id);
      if (frame < object.added || (object.removed && frame >= *object.removed)) continue;
      const auto index = static_cast<std::size_t>(frame - object.added);
      if (object.page.motion == Motion::deformable)
        page.set_positions(object.id, object.positions[index]);
      else
        page.set_pose(object.id, object.poses[index]);
    }
    if (frame == 10 || frame == 50) page.mark_diverged();
    page.mark_dropped(frame == 11 || frame == 12 ? frame : 0);
    page.frame(source_number(frame), scene.reports[static_cast<std::size_t>(frame)]);
  }
  page.mark_dropped(3);
  page.close();
}

io::PageOptions options_of(const PagePlay& scene) {
  io::PageOptions options;
  options.title = "a </script> title";
  options.source = "scene.json";
  options.settings = scene.settings;
  return options;
}

std::shared_ptr<const Mesh> grid(std::uint32_t side) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 4>> quads;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) points.emplace_back(x, y, 0.0);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * (side + 1) + x;
      quads.push_back({a, a + 1, a + side + 2, a + side + 1});
    }
  return std::make_shared<const Mesh>(Mesh::from_quads(points, quads));
}

void write_waves(io::PageWriter& page, const std::shared_ptr<const Mesh>& mesh, std::uint64_t frames) {
  const ObjectId id{0, 1};
  page.add_object(id, {"waves", mesh, Motion::deformable, 0});
  std::vector<Eigen::Vector3d> points(mesh->rest().begin(), mesh->rest().end());
  for (std::uint64_t frame = 0; frame < frames; ++frame) {
    for (Eigen::Vector3d& point : points)
      point.z() = std::sin(0.3 * point.x() + 0.1 * static_cast<double>(frame)) * std::cos(point.y());
    page.set_positions(id, points);
    page.frame(frame, {});
  }
}

}  // namespace graze::tests
