#include "scene/scene_placement.hpp"

#include <cmath>
#include <graze/error.hpp>
#include <limits>
#include <string>

namespace graze::io {
namespace {

/// Quaternions and matrices may be of single precision, or written with few digits.
constexpr double tolerance = 1e-3;
constexpr std::uint32_t last_frame = std::numeric_limits<std::uint32_t>::max() - 1;

/// A number other than 0, or three for the three axes.
Eigen::Matrix3d read_scale(const JsonPath& json) {
  constexpr std::string_view expected = "a number other than 0, or three of them";
  constexpr std::string_view remedy = "write 0.5 or [1, -1, 1]";
  Eigen::Vector3d scale;
  if (json.value().is_number())
    scale.setConstant(json.number());
  else if (json.value().is_array() && json.value().size() == 3)
    scale = json.point();
  else
    json.fail(expected, remedy);
  if ((scale.array() == 0).any()) json.fail(expected, remedy);
  return scale.asDiagonal();
}

Eigen::Matrix3d read_quaternion(const JsonPath& json) {
  const auto numbers = json.numbers(4, "write [x, y, z, w], w last");
  const Eigen::Quaterniond quaternion(numbers[3], numbers[0], numbers[1], numbers[2]);
  if (std::abs(quaternion.norm() - 1) > tolerance)
    json.fail("a quaternion of length 1", "write [x, y, z, w], w last; no turn is [0, 0, 0, 1]");
  return quaternion.normalized().toRotationMatrix();
}

/// Four rows of four numbers.
Placement read_matrix(const JsonPath& json) {
  constexpr std::string_view remedy = "write four rows of four numbers, [[1, 0, 0, x], …, [0, 0, 0, 1]]";
  if (!json.value().is_array() || json.value().size() != 4) json.fail("a 4 × 4 matrix", remedy);
  Eigen::Matrix4d matrix;
  for (std::size_t row = 0; row < 4; ++row) {
    const auto numbers = json.item(row).numbers(4, remedy);
    for (std::size_t column = 0; column < 4; ++column)
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = numbers[column];
  }
  try {
    return placement_from_matrix(matrix);
  } catch (const Error& error) {
    json.refuse(std::string(error.what()) + "; " + std::string(remedy));
  }
}

/// Reads where something stands into `placement`, which says what holds for the keys that are left out.
void read_pose(const JsonPath& json, Placement& placement) {
  const auto translate = json.find("translate");
  const auto degrees = json.find("rotate_degrees");
  const auto quaternion = json.find("rotate_quaternion");
  const auto matrix = json.find("matrix");
  if (degrees && quaternion) quaternion->refuse("stands beside rotate_degrees; keep one of the two");
  if (matrix && (translate || degrees || quaternion || json.find("scale")))
    matrix->refuse("says all of where it stands; leave out the other keys, or the matrix");
  if (translate) placement.translate = translate->point();
  if (degrees) placement.rotation = rotation_from_degrees(degrees->point());
  if (quaternion) placement.rotation = read_quaternion(*quaternion);
  if (matrix) placement = read_matrix(*matrix);
}

/// A key states the pose itself. What it leaves out is the transform's.
KeyPose read_key_pose(const JsonPath& json, const Placement& transform) {
  json.expect_keys({"frame", "translate", "rotate_degrees", "rotate_quaternion", "matrix"});
  const auto frame = json.require("frame", "say at which frame this pose holds").whole_number(0, last_frame);
  Placement placement = transform;
  read_pose(json, placement);
  if (json.find("matrix") && !placement.stretch.isApprox(Eigen::Matrix3d::Identity(), tolerance))
    json.find("matrix")->refuse(
        "it scales, shears or mirrors, and a pose only turns and moves; put the scale into transform");
  return {frame, placement.translate, placement.rotation};
}

}  // namespace

Placement read_placement(const JsonPath& json) {
  json.expect_keys({"translate", "rotate_degrees", "rotate_quaternion", "matrix", "scale"});
  Placement placement;
  read_pose(json, placement);
  if (const auto scale = json.find("scale")) placement.stretch = read_scale(*scale);
  return placement;
}

std::vector<KeyPose> read_poses(const JsonPath& json, const Placement& transform) {
  constexpr std::string_view remedy = R"(write [{"frame": 0, "translate": [x, y, z]}, ...])";
  if (json.array_size(remedy) == 0) json.fail("at least one pose", remedy);
  std::vector<KeyPose> keys;
  for (std::size_t i = 0; i < json.value().size(); ++i) {
    const JsonPath item = json.item(i);
    const KeyPose key = read_key_pose(item, transform);
    if (!keys.empty() && key.frame <= keys.back().frame)
      item.find("frame")->fail("a frame after " + std::to_string(keys.back().frame),
                               "list poses in order of frames");
    keys.push_back(key);
  }
  return keys;
}

}  // namespace graze::io
