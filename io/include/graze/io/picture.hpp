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

/// @addtogroup io_pictures
/// @{

/// Says what a picture shows.
struct PictureScene {
  /// A surface in a picture.
  struct Object {
    /// The faces of the surface.
    std::shared_ptr<const Mesh> mesh;
    /// A position for each vertex of the mesh. Faces with a vertex that is not finite are left out.
    std::vector<Eigen::Vector3d> positions;
  };
  /// The surfaces to draw.
  std::vector<Object> objects{};
  /// Contacts. Each is a dot, with a line along its normal.
  std::vector<Contact> contacts{};
  /// Pairs of points. Each is a line between the two points.
  std::vector<std::array<Eigen::Vector3d, 2>> distances{};
  /// Region distances. Each is a line between two middle vertices: red at level 1, green at level 2 and blue
  /// at level 3, as in figure 7 of the paper, and darker beyond.
  std::vector<RegionDistance> region_distances{};
  /// Ways out of pairs. Each is a purple arrow from WayOut::point, as long as WayOut::thickness, or a little
  /// longer so that it is seen. One without a direction is not drawn.
  std::vector<WayOut> ways_out{};
};

/// Says how a picture is drawn.
struct PictureSettings {
  /// The width in pixels.
  int width = 1280;
  /// The height in pixels.
  int height = 800;
  /// The number of samples along each side of a pixel. More of them make smoother edges.
  int supersampling = 3;
  /// The direction from the scene to the eye. Its length plays no part. Up is +z.
  Eigen::Vector3d to_camera = {0.62, -1.0, 0.52};
};

/// Draws a scene into a PNG file. Surfaces are shaded, with their edges, on a floor that takes their shadows.
/// The camera frames all objects. Contacts behind a surface shine through.
///
/// Throws InputError if the file cannot be written, or if the scene has no face with finite corners.
GRAZE_API void write_picture(const std::filesystem::path& path, const PictureScene& scene,
                             const PictureSettings& settings = {});

/// @}

}  // namespace graze::io
