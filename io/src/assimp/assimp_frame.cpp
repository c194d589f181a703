#include "assimp/assimp_frame.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assimp/assimp_convert.hpp"
#include "mesh/axes.hpp"

namespace graze::io {
namespace {

std::optional<std::int32_t> whole_number(const aiMetadata& data, const char* key) {
  std::int32_t number = 0;
  if (!data.Get(key, number)) return std::nullopt;
  return number;
}

std::optional<double> real_number(const aiMetadata& data, const char* key) {
  double number = 0;
  if (data.Get(key, number)) return number;
  float single = 0;
  if (data.Get(key, single)) return static_cast<double>(single);
  return std::nullopt;
}

struct Axis {
  std::int32_t number = 0;
  std::int32_t sign = 1;

  [[nodiscard]] Eigen::Vector3d direction() const {
    return (sign < 0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(number);
  }
  [[nodiscard]] std::string text() const {
    return (sign < 0 ? "-" : "") + std::string(1, static_cast<char>('x' + number));
  }
};

std::optional<Axis> read_axis(const aiMetadata& data, const char* key, const char* sign_key) {
  const auto number = whole_number(data, key);
  if (!number || *number < 0 || *number > 2) return std::nullopt;
  return Axis{*number, whole_number(data, sign_key).value_or(1)};
}

}  // namespace

FileFrame undo_collada_frame(aiScene& scene) {
  FileFrame frame;
  if (scene.mRootNode == nullptr) return frame;
  const Eigen::Matrix3d linear = to_eigen(scene.mRootNode->mTransformation).linear();
  const double unit = std::cbrt(linear.determinant());
  scene.mRootNode->mTransformation = aiMatrix4x4();
  if (!(unit > 0) || !std::isfinite(unit)) return frame;
  // assimp has rounded the file's unit to a float.
  const double rounded = std::round(unit * 1e7) / 1e7;
  frame.metres_per_unit = rounded > 0 ? rounded : unit;
  const Eigen::Matrix3d to_y_up = linear / unit;
  const bool is_x = to_y_up(1, 0) > 0.5;
  const bool is_z = to_y_up(1, 2) > 0.5;
  frame.up = is_x ? "x" : is_z ? "z" : "y";
  frame.to_z_up = z_up_from(is_x ? UpAxis::x : is_z ? UpAxis::z : UpAxis::y);
  return frame;
}

FileFrame read_fbx_frame(const aiScene& scene) {
  FileFrame frame;
  if (scene.mMetaData == nullptr) return frame;
  const aiMetadata& data = *scene.mMetaData;
  constexpr double metres_per_centimetre = 0.01;
  const auto factor = real_number(data, "UnitScaleFactor");
  if (factor && *factor > 0 && std::isfinite(*factor))
    frame.metres_per_unit = *factor * metres_per_centimetre;
  const auto up = read_axis(data, "UpAxis", "UpAxisSign");
  const auto front = read_axis(data, "FrontAxis", "FrontAxisSign");
  const auto right = read_axis(data, "CoordAxis", "CoordAxisSign");
  if (!up || !front || !right) return frame;
  const Eigen::Matrix3d turn = z_up_from(right->direction(), up->direction(), front->direction());
  if (turn.determinant() == 0) return frame;
  frame.up = up->text();
  frame.to_z_up = turn;
  return frame;
}

void undo_turn_to_y_up(aiScene& scene, std::string_view extension) {
  constexpr std::array<std::string_view, 8> turned = {".3ds", ".ase", ".ask",     ".dxf",
                                                      ".iqm", ".md2", ".md5mesh", ".mdc"};
  if (scene.mRootNode == nullptr || std::ranges::find(turned, extension) == turned.end()) return;
  const aiMatrix4x4 turn(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
  aiMatrix4x4& root = scene.mRootNode->mTransformation;
  if (!root.Equal(turn, 1e-6F)) return;
  root = aiMatrix4x4();
}

}  // namespace graze::io
