#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <graze/io/scene_file.hpp>
#include <string>

namespace graze::io {

/// Turns axes of which `up` points up to those in which z does. From y up, (x, y, z) becomes (x, −z, y). From
/// x up, (x, y, z) becomes (−y, −z, x).
Eigen::Matrix3d z_up_from(UpAxis up);

/// Turns axes to those with x right and z up. The arguments are the directions in the file that point right,
/// up and to the front, towards the viewer.
Eigen::Matrix3d z_up_from(const Eigen::Vector3d& right, const Eigen::Vector3d& up,
                          const Eigen::Vector3d& front);

/// Puts into words what a file says of its axes and unit, such as "y up and 0.0254 m a unit". It is empty
/// where it says nothing.
std::string text_of_frame(const FileFrame& frame);

/// Whether the file says anything but "metres, z up", in a format where that is the exporter's choice. glTF
/// always has y up and metres, which is no news.
bool says_other_than_scene(const std::filesystem::path& path, const FileFrame& frame);

/// Puts into words what a conversion does, such as "x y z become x −z y, times 0.0254".
std::string text_of_map(const Eigen::Matrix3d& map);

}  // namespace graze::io
