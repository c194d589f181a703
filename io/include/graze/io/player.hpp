#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/scene_file.hpp>
#include <graze/io/scene_object.hpp>
#include <graze/pair_filters.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace graze::io {

/// @addtogroup io_scenes
/// @{

/// Plays a described scene: it loads the meshes and motions, and gives the scene the positions of each frame.
///
///     Player player(read_scene_file("scene.json"));
///     for (std::uint32_t frame = 0; frame < player.frame_count(); ++frame) {
///       player.advance(frame);
///       ReportHandle report = player.scene().step();
///     }
///
/// One thread at a time may use a player.
class GRAZE_API Player {
 public:
  /// Loads every file and makes the scene. Throws InputError if a file cannot be read or does not fit its
  /// mesh. Also throws InputError if a node, an animation or a name is not there, or if Scene refuses the
  /// settings. Also throws InputError if there is not enough memory, and if the entries of `ignore` take out
  /// more than 1,000,000 pairs. The objects of an entry that is ignored with itself count as no pair: they
  /// get a group of their own (ObjectSettings::group).
  explicit Player(const SceneDescription& description);
  /// Frees the scene and all that was loaded.
  ~Player();
  /// Takes everything of the other player, which may then only be destroyed or assigned to.
  Player(Player&&) noexcept;
  /// Frees this player and takes everything of the other one, which may then only be destroyed or assigned
  /// to.
  Player& operator=(Player&&) noexcept;

  /// Returns the scene, for the caller to step.
  [[nodiscard]] Scene& scene();
  /// Returns the objects of the scene, in the order in which they were added.
  [[nodiscard]] std::span<const SceneObject> objects() const;
  /// Returns the rules and the ignored pairs of the description. They stay as they are.
  [[nodiscard]] const PairFilters& pair_filters() const;
  /// Returns the number of frames of the description, or of the longest motion if the description has none.
  /// It is at least 1.
  [[nodiscard]] std::uint32_t frame_count() const;
  /// Returns a line for each thing that loading left out or changed, and for what is odd in the frames that
  /// were read (PositionSource::warnings()). advance() may add lines.
  [[nodiscard]] std::span<const std::string> warnings() const;
  /// Returns the files that the player reads, now or in a later frame: mesh files, the files that these name,
  /// sequences and vertex caches. A program that writes files must not write into one of them.
  [[nodiscard]] std::span<const std::filesystem::path> files() const;

  /// Gives the scene the positions and poses of a frame, counted from 0. Past the end of a motion its last
  /// frame holds. The player reads positions into memory that the scene is bound to, so no step may run
  /// meanwhile.
  ///
  /// Throws InputError, with object and frame, if a file of the motion cannot be read. Positions that are not
  /// finite are no error here: the next report has a Diagnostic.
  void advance(std::uint32_t frame);

  /// Gives the positions of the vertices of object `index` after the last advance(). `index` is one into
  /// objects(), and is not checked.
  void read_positions(std::size_t index, std::vector<Eigen::Vector3d>& positions) const;
  /// Returns the pose of a rigid or fixed object after the last advance(). It is the identity for a
  /// deformable object. `index` is one into objects(), and is not checked.
  [[nodiscard]] const Eigen::Isometry3d& pose(std::size_t index) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze::io
