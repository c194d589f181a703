#include "examples/loops/organs.hpp"

#include <cmath>
#include <filesystem>
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
    point.x() += static_cast<float>(side * 40.2);
  }
  return shape;
}

/// An object of an OBJ file.
struct NamedShape {
  std::string name;
  Shape shape;
};

/// Reads the corners of a triangle, whose numbers begin with that of the object's first vertex. A corner may
/// be followed by numbers of textures and normals, after a slash.
std::array<std::uint32_t, 3> read_triangle(std::istringstream& words, std::size_t first_vertex,
                                           const std::string& file) {
  std::array<std::uint32_t, 3> triangle{};
  std::size_t count = 0;
  for (std::string word; words >> word; ++count)
    if (count < 3) triangle[count] = static_cast<std::uint32_t>(std::stoul(word) - first_vertex);
  if (count != 3) throw graze::Error(file + ": has a face that is no triangle");
  return triangle;
}

std::vector<NamedShape> read_obj(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw graze::Error(file + ": cannot be read");
  std::vector<NamedShape> objects;
  std::size_t first_vertex = 1;  // of the object that is being read
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "o") {
      if (!objects.empty()) first_vertex += objects.back().shape.points.size();
      words >> objects.emplace_back().name;
    } else if (word == "v" && !objects.empty()) {
      Eigen::Vector3f& point = objects.back().shape.points.emplace_back();
      words >> point.x() >> point.y() >> point.z();
    } else if (word == "f" && !objects.empty()) {
      objects.back().shape.triangles.push_back(read_triangle(words, first_vertex, file));
    }
  }
  return objects;
}

Organs read_organs(const std::string& file) {
  std::vector<NamedShape> objects = read_obj(file);
  if (objects.size() < 2) throw graze::Error(file + ": has not two objects");
  Organs organs;
  for (std::size_t i = 0; i < 2; ++i) {
    NamedShape& object = objects[objects.size() - 2 + i];
    organs.shapes[i] = std::move(object.shape);
    organs.names[i] = std::move(object.name);
  }
  organs.source = "read from " + file;
  organs.are_real = true;
  return organs;
}

Organs generated_organs(const std::string& reason) {
  return {{blob(-1), blob(1)}, {"left organ", "right organ"}, "generated, since " + reason};
}

}  // namespace

Organs load_organs(const Options& options) {
  if (!options.organs.empty()) return read_organs(options.organs);
  if (options.blobs) return generated_organs("--blobs asks for it");
  const std::string file = GRAZE_SHARED_DATA "/organs/body_large_small_intestine.obj";
  if (!std::filesystem::exists(file)) return generated_organs(file + " is not there");
  return read_organs(file);
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
