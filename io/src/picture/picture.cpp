#include <Eigen/Geometry>
#include <graze/io/error.hpp>
#include <graze/io/picture.hpp>
#include <limits>

#include "picture/picture_parts.hpp"
#include "picture/png_file.hpp"

namespace graze::io {
namespace {

using Eigen::Vector3d;

constexpr double ambient_sky = 0.62;
constexpr double ambient_ground = 0.40;
constexpr double key_light = 0.52;
constexpr double wire_darkness = 0.30;
const Vector3d horizon_colour(0.955, 0.960, 0.970);
const Vector3d zenith_colour(0.80, 0.85, 0.91);

/// Distinct, muted, so that the marks stand out. Beyond the last they start again, lighter.
Vector3d object_colour(std::size_t index) {
  static const std::array<Vector3d, 8> palette{{{0.36, 0.55, 0.76},
                                                {0.86, 0.52, 0.36},
                                                {0.45, 0.66, 0.47},
                                                {0.62, 0.49, 0.72},
                                                {0.82, 0.70, 0.38},
                                                {0.38, 0.66, 0.68},
                                                {0.66, 0.64, 0.60},
                                                {0.80, 0.51, 0.60}}};
  const double lighter = 0.25 * static_cast<double>((index / palette.size()) % 3);
  return palette[index % palette.size()] * (1 - lighter) + Vector3d::Constant(lighter);
}

/// The paper's colours of the lines of each level, told apart by the colour-blind through their lightness.
Vector3d level_colour(std::uint32_t level) {
  static const std::array<Vector3d, 4> palette{
      {{0.84, 0.19, 0.15}, {0.10, 0.60, 0.31}, {0.12, 0.31, 0.85}, {0.30, 0.28, 0.36}}};
  return palette[std::min<std::size_t>(level == 0 ? 0 : level - 1, palette.size() - 1)];
}

/// Draws surfaces, then floor and sky behind them.
class Painter {
 public:
  Painter(const PictureScene& scene, const PictureSettings& settings)
      : scene_(scene),
        triangles_(list_triangles(scene)),
        camera_(frame_camera(triangles_, settings)),
        shadows_(triangles_, camera_),
        image_(camera_.width, camera_.height, horizon_colour),
        depth_(camera_.width, camera_.height, 0.0F) {
    for (const PictureTriangle& triangle : triangles_)
      for (const Vector3d& point : triangle.points) box_.extend(point);
  }

  void draw_surfaces() {
    for (const PictureTriangle& triangle : triangles_) draw(triangle);
  }
  void draw_background();
  void draw_marks();
  [[nodiscard]] const Grid<Vector3d>& image() const { return image_; }

 private:
  void draw(const PictureTriangle& triangle);
  [[nodiscard]] Vector3d shade(const Vector3d& colour, Vector3d normal, const Vector3d& point) const;
  void draw_disc(const Vector3d& point, double radius, const Vector3d& colour);
  void draw_line(const Vector3d& from, const Vector3d& to, double radius, const Vector3d& colour);
  void draw_way_out(const WayOut& way);

  const PictureScene& scene_;
  std::vector<PictureTriangle> triangles_;
  Camera camera_;
  ShadowMap shadows_;
  Grid<Vector3d> image_;
  Grid<float> depth_;
  Eigen::AlignedBox3d box_;
};

Vector3d Painter::shade(const Vector3d& colour, Vector3d normal, const Vector3d& point) const {
  const Vector3d to_eye = (camera_.eye - point).normalized();
  if (normal.dot(to_eye) < 0) normal = -normal;
  const double sky = 0.5 + 0.5 * normal.z();
  const double facing = std::max(0.0, normal.dot(shadows_.to_light()));
  const double lit = facing > 0 ? shadows_.light_at(point, normal) : 0;
  const Vector3d half_way = (to_eye + shadows_.to_light()).normalized();
  const double shine = 0.12 * lit * std::pow(std::max(0.0, normal.dot(half_way)), 40);
  const double light = ambient_ground + (ambient_sky - ambient_ground) * sky + key_light * facing * lit;
  return colour * light + Vector3d::Constant(shine);
}

void Painter::draw(const PictureTriangle& triangle) {
  const ScreenTriangle screen = camera_.project(triangle.points);
  const double area = std::abs(cross_2d(screen[0], screen[1], screen[2]));
  const Vector3d colour = object_colour(triangle.object);
  const double line_width = 0.55 * camera_.supersampling;
  for_each_sample(screen, image_.width, image_.height, [&](int x, int y, const Vector3d& weights) {
    const double z = weights[0] * screen[0].z() + weights[1] * screen[1].z() + weights[2] * screen[2].z();
    if (static_cast<float>(z) <= depth_.at(x, y)) return;
    depth_.at(x, y) = static_cast<float>(z);
    const Vector3d normal = (weights[0] * triangle.normals[0] + weights[1] * triangle.normals[1] +
                             weights[2] * triangle.normals[2])
                                .normalized();
    double wire = 0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3d side = screen[(corner + 2) % 3] - screen[(corner + 1) % 3];
      const double height = area / std::max(1e-9, side.head<2>().norm());
      const double away = weights[static_cast<Eigen::Index>(corner)] * height;
      const double faint =
          std::clamp(height / (9.0 * camera_.supersampling), 0.0, 1.0);  // dense meshes stay light
      if (triangle.is_edge[corner])
        wire = std::max(wire, faint * std::clamp(1.5 - away / line_width, 0.0, 1.0));
    }
    image_.at(x, y) = shade(colour, normal, camera_.point_at(x, y, z)) * (1 - wire_darkness * wire);
  });
}

void Painter::draw_background() {
  const Vector3d centre = 0.5 * (box_.min() + box_.max());
  const double floor = box_.min().z() - 1e-4 * (box_.max() - box_.min()).norm();
  const double reach = 1.6 * (box_.max() - box_.min()).norm();
  for (int y = 0; y < image_.height; ++y)
    for (int x = 0; x < image_.width; ++x) {
      if (depth_.at(x, y) > 0) continue;
      const Vector3d ray = camera_.ray(x, y);
      const double height = std::clamp(1.0 - static_cast<double>(y) / image_.height, 0.0, 1.0);
      Vector3d colour = horizon_colour + (zenith_colour - horizon_colour) * height * height;
      if (ray.z() < 0) {
        const Vector3d point = camera_.eye + ray * ((floor - camera_.eye.z()) / ray.z());
        const double near = std::clamp(1.0 - (point - centre).norm() / reach, 0.0, 1.0);
        const double shadow = 1.0 - shadows_.light_at(point, Vector3d::UnitZ());
        colour *= 1.0 - 0.30 * shadow * std::sqrt(near);
      }
      image_.at(x, y) = colour;
    }
}

/// Full strength where seen, faint where a surface hides it.
void Painter::draw_disc(const Vector3d& point, double radius, const Vector3d& colour) {
  const Vector3d centre = camera_.project(point);
  if (!centre.allFinite() || std::abs(centre.x()) > 1e6 || std::abs(centre.y()) > 1e6) return;
  const double reach = radius * camera_.supersampling;
  for (int y = static_cast<int>(centre.y() - reach) - 1; y <= static_cast<int>(centre.y() + reach) + 1; ++y)
    for (int x = static_cast<int>(centre.x() - reach) - 1; x <= static_cast<int>(centre.x() + reach) + 1;
         ++x) {
      if (!image_.contains(x, y) || std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y()) > reach) continue;
      const bool is_hidden = centre.z() * 1.01 < static_cast<double>(depth_.at(x, y));
      const double strength = is_hidden ? 0.35 : 1.0;
      image_.at(x, y) += strength * (colour - image_.at(x, y));
    }
}

void Painter::draw_line(const Vector3d& from, const Vector3d& to, double radius, const Vector3d& colour) {
  const double samples = (camera_.project(to) - camera_.project(from)).head<2>().norm();
  const double step = std::max(0.5, 0.5 * radius * camera_.supersampling);
  if (!std::isfinite(samples) || samples > 1e6) return;
  const int count = 1 + static_cast<int>(samples / step);
  for (int i = 0; i <= count; ++i)
    draw_disc(from + (to - from) * (static_cast<double>(i) / count), radius, colour);
}

/// A shaft and a head that narrows to the tip, with a dark rim.
void Painter::draw_way_out(const WayOut& way) {
  const Vector3d dark(0.13, 0.05, 0.17);
  const Vector3d purple(0.72, 0.34, 0.86);
  const double least = 0.08 * (box_.max() - box_.min()).norm();
  const Vector3d along = std::max(way.thickness, least) * way.direction;
  const Vector3d tip = way.point + along;
  const Vector3d neck = tip - 0.5 * least * way.direction;
  constexpr int rings = 40;
  for (const auto& [rim, colour] : {std::pair(1.0, dark), std::pair(0.0, purple)}) {
    draw_line(way.point, neck, 1.7 + rim, colour);
    for (int ring = 0; ring <= rings; ++ring) {
      const double share = static_cast<double>(ring) / rings;
      draw_disc(neck + share * (tip - neck), 5.5 * (1 - share) + rim, colour);
    }
  }
}

void Painter::draw_marks() {
  const Vector3d dark(0.16, 0.08, 0.06);
  const Vector3d contact_colour(0.98, 0.20, 0.14);
  const Vector3d normal_colour(1.0, 0.80, 0.16);
  const Vector3d distance_colour(0.15, 0.25, 0.55);
  // A few contacts are drawn large, thousands small enough to be told apart.
  const double size =
      std::clamp(12.0 / std::sqrt(1.0 + static_cast<double>(scene_.contacts.size())), 0.45, 1.0);
  const double normal_length = 0.045 * size * (box_.max() - box_.min()).norm();
  for (const RegionDistance& region : scene_.region_distances)
    draw_line(region.point_a, region.point_b, 0.6, level_colour(region.level));
  for (const auto& [from, to] : scene_.distances) {
    draw_line(from, to, 1.0, distance_colour);
    draw_disc(from, 2.4, distance_colour);
    draw_disc(to, 2.4, distance_colour);
  }
  for (const Contact& contact : scene_.contacts)
    draw_line(contact.point_b, contact.point_b + normal_length * contact.normal, 0.8 * size, normal_colour);
  for (const Contact& contact : scene_.contacts) draw_disc(contact.point_b, 3.6 * size, dark);
  for (const Contact& contact : scene_.contacts) draw_disc(contact.point_b, 2.8 * size, contact_colour);
  for (const WayOut& way : scene_.ways_out)
    if (!way.direction.isZero(0)) draw_way_out(way);
}

/// Averages the samples of each pixel.
std::vector<std::uint8_t> resolve(const Grid<Vector3d>& image, const PictureSettings& settings) {
  std::vector<std::uint8_t> rgb;
  const int n = settings.supersampling;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      Vector3d sum = Vector3d::Zero();
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) sum += image.at(x * n + i, y * n + j).cwiseMin(1.0).cwiseMax(0.0);
      for (int channel = 0; channel < 3; ++channel)
        rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * sum[channel] / (n * n))));
    }
  return rgb;
}

}  // namespace

void write_picture(const std::filesystem::path& path, const PictureScene& scene,
                   const PictureSettings& settings) {
  Painter painter(scene, settings);
  painter.draw_surfaces();
  painter.draw_background();
  painter.draw_marks();
  write_png(path, settings.width, settings.height, resolve(painter.image(), settings));
}

}  // namespace graze::io
