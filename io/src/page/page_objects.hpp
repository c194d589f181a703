#pragma once

#include <cstdint>
#include <functional>
#include <graze/io/page.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "page/mesh_table.hpp"
#include "page/motion_table.hpp"

namespace graze::io {

/// An object of a page that is being written. Frames are counted in calls of PageWriter::frame().
struct WrittenObject {
  std::string name;
  Motion motion = Motion::deformable;
  bool solid = false;
  bool swept = false;
  ObjectSettings settings;
  std::size_t mesh_number = 0;
  std::uint64_t user_data = 0;
  std::uint64_t added = 0;                              ///< the first frame in which it exists
  std::optional<std::uint64_t> removed = std::nullopt;  ///< the first frame in which it does no longer
  std::optional<std::uint32_t> before = std::nullopt;   ///< the removed object that had the same id
  std::shared_ptr<const Mesh> mesh;                     ///< until nothing needs it any more
  PageShape shown;                                      ///< before the frames that wait to be written
  PageShape latest;                                     ///< as the last call says
  bool has_moved = false;                               ///< since the last frame of the page
  double position_error = 0;
};

/// The objects of a page, in the order in which they were added.
class PageObjects {
 public:
  /// Adds an object that exists from `frame` on. Throws Error as PageWriter::add_object.
  void add(ObjectId id, const PageObject& object, std::size_t mesh_number, std::uint64_t frame);
  /// Throws Error as PageWriter::remove_object.
  void remove(ObjectId id, std::uint64_t frame);
  /// Moves an object. Throws Error as PageWriter::set_positions and PageWriter::set_pose.
  void set_positions(ObjectId id, const PositionView& positions);
  void set_pose(ObjectId id, const std::array<double, 12>& rows);

  /// Notes that an object has moved since the last frame of the page.
  void note_motion(std::size_t index);
  /// The objects that have moved since the last call, each once.
  [[nodiscard]] std::vector<std::size_t> take_moved();
  /// Notes where an object is in the last frame that was written.
  void show(std::size_t index, const PageShape& shape) { objects_[index].shown = shape; }
  void note_error(std::size_t index, double error);
  /// Frees the positions of removed objects that no frame to come shows, by the frame of their removal.
  void forget_removed(const std::function<bool(std::uint64_t)>& is_past);

  /// The last object that was added with an id.
  [[nodiscard]] std::optional<std::uint32_t> index_of(ObjectId id) const;
  /// The object that an id named in a frame.
  [[nodiscard]] std::optional<std::uint32_t> index_of(ObjectId id, std::uint64_t frame) const;
  [[nodiscard]] const std::vector<WrittenObject>& all() const { return objects_; }
  /// Ascending indices of the objects that frames not yet written may show.
  [[nodiscard]] const std::vector<std::size_t>& alive() const { return alive_; }

 private:
  std::size_t present(ObjectId id) const;

  std::vector<WrittenObject> objects_;
  std::unordered_map<ObjectId, std::uint32_t> indices_;
  std::vector<std::size_t> alive_;
  std::vector<std::size_t> moved_;
};

/// The numbers of meshes in a page. A mesh is known for as long as something else keeps it.
class PageMeshes {
 public:
  /// The number of a mesh, and whether it is new.
  std::pair<std::size_t, bool> number_of(const std::shared_ptr<const Mesh>& mesh);
  [[nodiscard]] const std::vector<MeshCounts>& counts() const { return counts_; }

 private:
  std::map<std::weak_ptr<const Mesh>, std::size_t, std::owner_less<>> numbers_;
  std::vector<MeshCounts> counts_;
};

}  // namespace graze::io
