#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <memory>
#include <vector>

namespace graze::io {

/// What one picture shows.
struct PictureScene {
  struct Object {
    std::shared_ptr<const Mesh> mesh;
    std::vector<Eigen::Vector3d> positions;  ///< one a vertex; faces at one that is not finite are left out
  };
  std::vector<Object> objects{};
  std::vector<Contact> contacts{};                          ///< a dot each, with a line along the normal
  std::vector<std::array<Eigen::Vector3d, 2>> distances{};  ///< a line between the two points
};

struct PictureSettings {
  int width = 1280;
  int height = 800;
  int supersampling = 3;                           ///< samples along each side of a pixel
  Eigen::Vector3d to_camera = {0.62, -1.0, 0.52};  ///< from the scene towards the eye; +z is up
};

/// Draws the scene into a PNG: shaded surfaces in distinct colours with their edges, on a floor that takes
/// their shadows; the camera frames all objects. Contacts behind a surface shine through. Throws InputError
/// for a file that cannot be written and a scene without a finite face.
GRAZE_API void write_picture(const std::filesystem::path& path, const PictureScene& scene,
                             const PictureSettings& settings = {});

}  // namespace graze::io
