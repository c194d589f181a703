#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <memory>
#include <vector>

#include "base/kept_by_reports.hpp"
#include "core/base/bytes_of.hpp"

namespace graze {

/// The mesh of each object of a report, by id. Reports that follow each other share all parts of it but those
/// in which a mesh has changed.
class KeptMeshes final : public KeptByReports {
 public:
  /// The mesh of an object, or null.
  [[nodiscard]] const std::shared_ptr<const Mesh>* find(ObjectId id) const {
    const std::size_t part = id.index / part_size;
    if (part >= parts_.size() || parts_[part] == nullptr) return nullptr;
    const Entry& entry = (*parts_[part])[id.index % part_size];
    return entry.mesh != nullptr && entry.generation == id.generation ? &entry.mesh : nullptr;
  }

  /// Begins with the meshes of another list, before any is set.
  void begin_with(const KeptMeshes& other) {
    parts_ = other.parts_;
    own_.assign(parts_.size(), 0);
  }
  /// Sets the mesh of an object, or null for one that is gone.
  void set(ObjectId id, std::shared_ptr<const Mesh> mesh);
  void clear() {
    parts_.clear();
    own_.clear();
  }
  [[nodiscard]] std::size_t byte_count() const {
    return sizeof(KeptMeshes) + bytes_of(parts_) + bytes_of(own_);
  }
  /// Bytes of the parts, which lists share.
  [[nodiscard]] std::size_t byte_count_of_parts() const { return parts_.size() * sizeof(Part); }

 private:
  static constexpr std::size_t part_size = 64;
  struct Entry {
    std::uint32_t generation = 0;
    std::shared_ptr<const Mesh> mesh;
  };
  using Part = std::array<Entry, part_size>;

  std::vector<std::shared_ptr<Part>> parts_;
  std::vector<std::uint8_t> own_;  ///< of each part, whether no other list has it
};

}  // namespace graze
