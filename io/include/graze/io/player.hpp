#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/export.hpp>
#include <graze/io/scene_file.hpp>
#include <graze/io/scene_object.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

/// A described scene with its meshes and motions loaded, ready to be stepped:
///
///     Player player(read_scene_file("scene.json"));
///     for (std::uint32_t frame = 0; frame < player.frame_count(); ++frame) {
///       player.advance(frame);
///       ReportHandle report = player.scene().step();
///     }
///
/// For one thread at a time.
class GRAZE_API Player {
 public:
  /// Loads every file. Throws InputError for a file that cannot be read or does not fit its mesh, a node,
  /// animation or name that is not there, and settings that Scene refuses.
  explicit Player(const SceneDescription& description);
  ~Player();
  Player(Player&&) noexcept;
  Player& operator=(Player&&) noexcept;

  [[nodiscard]] Scene& scene();
  /// The scene's objects in the order in which they were added.
  [[nodiscard]] std::span<const SceneObject> objects() const;
  /// The description's, or that of the longest motion; at least 1.
  [[nodiscard]] std::uint32_t frame_count() const;
  /// What importers and loaders noticed, a line each.
  [[nodiscard]] std::span<const std::string> warnings() const;

  /// Gives the scene the positions and poses of frame `frame`; past the end of a motion its last holds.
  /// Throws InputError, naming object and frame, when a file of the motion cannot be read. Positions that are
  /// not finite are no error: the scene answers them with a diagnostic.
  void advance(std::uint32_t frame);

  /// Where the vertices of object `index` stand after the last `advance`.
  void read_positions(std::size_t index, std::vector<Eigen::Vector3d>& positions) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace graze::io
