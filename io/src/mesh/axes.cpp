#include "mesh/axes.hpp"

#include <Eigen/LU>
#include <cmath>
#include <cstdio>

#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

std::string short_number(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

}  // namespace

Eigen::Matrix3d z_up_from(UpAxis up) {
  using Eigen::Vector3d;
  switch (up) {
    case UpAxis::x:
      return z_up_from(-Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ());
    case UpAxis::y:
      return z_up_from(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ());
    case UpAxis::z:
      break;
  }
  return Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d z_up_from(const Eigen::Vector3d& right, const Eigen::Vector3d& up,
                          const Eigen::Vector3d& front) {
  Eigen::Matrix3d turn;
  turn.row(0) = right;
  turn.row(1) = -front;
  turn.row(2) = up;
  return turn;
}

std::string text_of_frame(const FileFrame& frame) {
  std::string text = frame.up ? *frame.up + " up" : "";
  if (frame.metres_per_unit)
    text += (text.empty() ? "" : " and ") + short_number(*frame.metres_per_unit) + " m a unit";
  return text;
}

bool says_other_than_scene(const std::filesystem::path& path, const FileFrame& frame) {
  const std::string extension = lower_extension(path);
  if (extension == ".gltf" || extension == ".glb") return false;
  return frame.to_z_up != Eigen::Matrix3d::Identity() || frame.metres_per_unit.value_or(1) != 1;
}

std::string text_of_map(const Eigen::Matrix3d& map) {
  const double scale = std::cbrt(std::abs(map.determinant()));
  std::string text;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      if (std::abs(map(row, column)) > 0.5 * scale)
        text += std::string(text.empty() ? "" : " ") + (map(row, column) < 0 ? "-" : "") +
                static_cast<char>('x' + column);
  text = text == "x y z" ? "" : "x y z become " + text;
  if (scale == 1) return text;
  return text + (text.empty() ? "" : ", ") + "times " + short_number(scale);
}

}  // namespace graze::io
