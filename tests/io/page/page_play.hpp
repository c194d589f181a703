#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <graze/io/page.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace graze::tests {

/// An object of a played scene, with where it was in each frame in which it existed.
struct PlayedObject {
  ObjectId id;
  io::PageObject page;
  std::uint64_t added = 0;
  std::optional<std::uint64_t> removed;
  std::vector<std::vector<Eigen::Vector3d>> positions;  ///< by frame since it was added, of a deformable one
  std::vector<std::array<double, 12>> poses;            ///< of another one
};

/// A small scene of deformable, rigid and fixed objects that come and go, with all its reports, which
/// mark_report() has marked. Deformable objects are tested against themselves, and the rigid one is swept.
struct PagePlay {
  SceneSettings settings;
  std::vector<PlayedObject> objects;
  std::vector<FrameReport> reports;
};

/// The number that a frame has in its source.
constexpr std::uint64_t source_number(std::uint64_t frame) {
  return 1000 + frame;
}

/// Plays 75 frames. In frame 5 a vertex is not finite, frames 20 to 24 are all the same, an object comes in
/// frame 7 and one goes in frame 40 while it is in contact.
const PagePlay& page_play();

/// The template of a page, which has no viewer.
inline const std::string page_template =
    "<html>\n<head></head>\n<!-- graze-data -->\n<script>play()</script>\n</html>\n";

/// The options of a page of a scene, with a title that could break the page.
io::PageOptions options_of(const PagePlay& scene);

/// Writes the scene into a page.
void write_page(const PagePlay& scene, io::PageWriter& page);

/// A square grid of side × side quads.
std::shared_ptr<const Mesh> grid(std::uint32_t side);

/// Writes `frames` frames of a waving grid into a page, without reports.
void write_waves(io::PageWriter& page, const std::shared_ptr<const Mesh>& mesh, std::uint64_t frames);

}  // namespace graze::tests
