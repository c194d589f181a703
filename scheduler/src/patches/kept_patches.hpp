#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/kept_by_reports.hpp"
#include "core/base/bytes_of.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/pair/group_filter.hpp"
#include "core/surface/surface_part.hpp"
#include "geometry/kept_geometry.hpp"

namespace graze {

/// The parts of an object's surface that patches have, as a step saw them. All patches of a report share
/// this. It does not change while a report has it.
struct PatchSurface {
  explicit PatchSurface(std::shared_ptr<const Mesh> of) : mesh(std::move(of)), part(mesh) {}

  std::shared_ptr<const Mesh> mesh;
  SurfacePart part;
};

/// An object of a patch.
struct KeptPatchObject {
  ObjectId id;
  bool is_first = false;  ///< it was added before the tool
  bool solid = false;
  std::shared_ptr<const PatchSurface> surface;
  std::shared_ptr<const FaceGroups> groups;    ///< null if no face is hidden
  std::shared_ptr<const GroupFilter> ignored;  ///< null unless some groups are ignored against the tool's
  std::size_t first_face = 0;                  ///< in KeptPatch::faces
  std::size_t face_count = 0;
};

/// The faces around a tool, and the tool itself, as a step saw them.
struct KeptPatch {
  ObjectId tool;
  bool solid = false;
  std::shared_ptr<const KeptSurface> surface;  ///< the tool's
  std::shared_ptr<const FaceGroups> groups;    ///< null if none of its faces is hidden
  /// No face of others that is not here is nearer. It is negative where the tool's place is not known.
  double radius = 0;
  bool cut = false;
  double threshold = 0;  ///< the largest of any pair of the tool
  std::vector<ObjectId> ids;
  std::vector<KeptPatchObject> objects;  ///< the same, in the order of addition
  std::vector<std::uint32_t> faces;

  [[nodiscard]] const KeptPatchObject* find(ObjectId id) const {
    const auto found = std::find(ids.begin(), ids.end(), id);
    return found == ids.end() ? nullptr : &objects[static_cast<std::size_t>(found - ids.begin())];
  }
};

/// All patches of a report.
class KeptPatches final : public KeptByReports {
 public:
  /// The patch of a tool, or null.
  [[nodiscard]] const KeptPatch* find(ObjectId tool) const {
    for (const KeptPatch& patch : patches())
      if (patch.tool == tool) return &patch;
    return nullptr;
  }
  /// Adds a patch, which is empty.
  [[nodiscard]] KeptPatch& add() {
    if (count_ == patches_.size()) patches_.emplace_back();
    return patches_[count_++];
  }
  /// Lets go of all surfaces, and keeps the memory of the lists.
  void clear() {
    for (KeptPatch& patch : patches_) {
      patch.surface.reset();
      patch.groups.reset();
      patch.ids.clear();
      patch.objects.clear();
      patch.faces.clear();
    }
    count_ = 0;
  }
  [[nodiscard]] std::size_t byte_count() const {
    std::size_t bytes = sizeof(KeptPatches) + bytes_of(patches_);
    for (const KeptPatch& patch : patches_)
      bytes += bytes_of(patch.ids) + bytes_of(patch.objects) + bytes_of(patch.faces);
    return bytes;
  }

 private:
  [[nodiscard]] std::span<const KeptPatch> patches() const { return std::span(patches_).first(count_); }

  std::vector<KeptPatch> patches_;
  std::size_t count_ = 0;  ///< those that are in use
};

}  // namespace graze
