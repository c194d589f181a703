#include "examples/loops/organs.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

namespace loops {
namespace {

/// Returns a blob of 1,922 vertices: a ball of 40 mm with bumps. It lies beside the origin, and touches the
/// other.
Shape blob(double side) {
  Shape shape = rounded(examples::ball(40, 48, 40));
  for (Eigen::Vector3f& point : shape.points) {
    point *= 1 + 0.04f * std::sin(0.12f * point.x()) * std::cos(0.15f * point.y());
    point.x() += static_cast<float>(side * 40.5);
  }
  return shape;
}

std::vector<Shape> read_obj(const std::string& file) {
  std::ifstream in(file);
  std::vector<Shape> shapes;
  std::uint32_t first = 1;  // the number of the first vertex of the object that is being read
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "o") {
      if (!shapes.empty()) first += static_cast<std::uint32_t>(shapes.back().points.size());
      shapes.emplace_back();
    } else if (word == "v" && !shapes.empty()) {
      Eigen::Vector3f& point = shapes.back().points.emplace_back();
      words >> point.x() >> point.y() >> point.z();
    } else if (word == "f" && !shapes.empty()) {
      std::array<std::uint32_t, 3>& triangle = shapes.back().triangles.emplace_back();
      for (std::uint32_t& corner : triangle) {
        words >> word;  // a corner may be followed by numbers of textures and normals, after a slash
        corner = static_cast<std::uint32_t>(std::stoul(word)) - first;
      }
    }
  }
  return shapes;
}

}  // namespace

Organs load_organs(const std::string& file) {
  Organs organs;
  if (!file.empty()) {
    std::vector<Shape> shapes = read_obj(file);
    if (shapes.size() < 2) throw graze::Error(file + ": has not two objects");
    organs.shapes[0] = std::move(shapes[shapes.size() - 2]);
    organs.shapes[1] = std::move(shapes[shapes.size() - 1]);
    organs.are_real = true;
    return organs;
  }
  organs.shapes[0] = blob(-1);
  organs.shapes[1] = blob(1);
  return organs;
}

void deform(const Shape& rest, double time, std::vector<Eigen::Vector3f>& points) {
  const auto breath = static_cast<float>(3 * std::sin(1.6 * time));
  for (std::size_t i = 0; i < rest.points.size(); ++i) {
    const Eigen::Vector3f& point = rest.points[i];
    const float wave = std::sin(0.08f * (point.x() + point.z()) - static_cast<float>(4 * time));
    points[i] = point + Eigen::Vector3f(0, breath + wave, 0.5f * wave);
  }
}

}  // namespace loops
