#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::tests {

/// A level sheet of n by n quads of side `cell`, its first vertex at `corner`.
inline oracle::Shape sheet(std::uint32_t n, double cell, const Eigen::Vector3d& corner) {
  oracle::Shape shape;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x)
      shape.positions.push_back(corner + cell * Eigen::Vector3d(x, y, 0));
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t first = y * (n + 1) + x;
      shape.faces.push_back({first, first + 1, first + n + 2, first + n + 1});
    }
  return shape;
}

/// A tetrahedron that points down: its tip is vertex 0, at `tip`.
inline oracle::Shape spike(const Eigen::Vector3d& tip, double size) {
  oracle::Shape shape;
  shape.positions = {tip, tip + size * Eigen::Vector3d(-0.25, -0.25, 1),
                     tip + size * Eigen::Vector3d(0.5, -0.25, 1),
                     tip + size * Eigen::Vector3d(-0.25, 0.5, 1.25)};
  shape.faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  return shape;
}

/// A box of six quads.
inline oracle::Shape box(const Eigen::Vector3d& low, const Eigen::Vector3d& size) {
  oracle::Shape shape;
  for (int i = 0; i < 8; ++i)
    shape.positions.push_back(low + size.cwiseProduct(Eigen::Vector3d(i & 1, (i >> 1) & 1, (i >> 2) & 1)));
  shape.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return shape;
}

inline oracle::Shape moved(oracle::Shape shape, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& point : shape.positions) point += by;
  return shape;
}

inline std::string number_text(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

inline std::string point_text(const Eigen::Vector3d& point) {
  return number_text(point.x()) + " " + number_text(point.y()) + " " + number_text(point.z());
}

inline std::string obj_text(const oracle::Shape& shape) {
  std::string text;
  for (const Eigen::Vector3d& point : shape.positions) text += "v " + point_text(point) + "\n";
  for (const auto& face : shape.faces) {
    text += "f";
    for (const std::uint32_t corner : face) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text;
}

inline std::string ply_text(const oracle::Shape& shape) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(shape.positions.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(shape.faces.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& point : shape.positions) text += point_text(point) + "\n";
  for (const auto& face : shape.faces) {
    text += std::to_string(face.size());
    for (const std::uint32_t corner : face) text += " " + std::to_string(corner);
    text += "\n";
  }
  return text;
}

template <typename Number>
void append_bytes(std::string& bytes, Number value) {
  const auto* first = reinterpret_cast<const char*>(&value);
  bytes.append(first, first + sizeof value);
}

/// A PC2 cache of positions, one list a frame. Coordinates become floats.
inline std::string pc2_bytes(const std::vector<std::vector<Eigen::Vector3d>>& frames) {
  std::string bytes("POINTCACHE2\0", 12);
  append_bytes(bytes, std::int32_t{1});
  append_bytes(bytes, static_cast<std::int32_t>(frames.at(0).size()));
  append_bytes(bytes, 0.0F);
  append_bytes(bytes, 1.0F);
  append_bytes(bytes, static_cast<std::int32_t>(frames.size()));
  for (const auto& positions : frames)
    for (const Eigen::Vector3d& point : positions)
      for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, static_cast<float>(point[axis]));
  return bytes;
}

}  // namespace graze::tests
