#pragma once

#include <array>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace graze::wasm {

/// A scene made of what a page holds. Its reports are tables of a page (docs/page_format.md), so that the
/// viewer shows them as it shows recorded ones. Functions throw Error as those of Scene and Mesh do.
class PageScene {
 public:
  /// Sets a setting of the scene by its key in the head of a page. A bool is 0 or 1. Returns false for a key
  /// that no setting of this kind has. It has an effect before the first object.
  bool set_number(std::string_view key, double value);
  /// Sets a setting that is an enumeration.
  bool set_word(std::string_view key, std::string_view word);
  void set_accuracy(const Accuracy& accuracy) { settings_.accuracy = accuracy; }

  /// Adds a mesh of triangles and quads, and returns its index.
  std::uint32_t add_mesh(std::span<const double> rest, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> corner_counts);
  /// Sets a setting of the next object by its name, as set_number() does.
  bool set_object_number(std::string_view name, double value);
  /// Sets the groups of the next object's faces, and which of them are hidden.
  void set_face_groups(std::span<const std::uint32_t> groups);
  void set_hidden_groups(std::span<const std::uint32_t> groups);
  /// Adds an object with the settings that were set since the last one. `page_index` is its index in the
  /// page.
  void add_object(std::uint32_t page_index, std::uint32_t mesh, Motion motion);
  /// Places a deformable object.
  void set_positions(std::uint32_t page_index, std::span<const double> positions);
  /// Places a rigid or fixed object by the upper three rows of its matrix.
  void set_pose(std::uint32_t page_index, const std::array<double, 12>& rows);

  /// Takes a pair out, or groups of its faces, as Scene::ignore() does.
  void ignore(std::uint32_t a, std::uint32_t b);
  void ignore(std::uint32_t a, std::uint8_t group_a, std::uint32_t b, std::uint8_t group_b);
  /// Gives thresholds to pairs of two kinds. A NaN leaves a threshold to the scene.
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, double contact_distance, double range,
                std::span<const double> epsilon);

  /// Steps, and returns the table of the report. `page_frame` and `number` say which frame of the page and of
  /// its source it stands for.
  const std::string& step(std::uint64_t page_frame, std::uint64_t number);
  /// The table of the last step.
  [[nodiscard]] const std::string& table() const { return table_; }

 private:
  Scene& scene();
  ObjectId id_of(std::uint32_t page_index) const;

  SceneSettings settings_;
  ObjectSettings object_settings_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::unique_ptr<Scene> scene_;
  std::unordered_map<std::uint32_t, ObjectId> ids_;  ///< by index in the page
  std::unordered_map<ObjectId, std::uint32_t> page_index_of_;
  std::string table_;
};

}  // namespace graze::wasm
