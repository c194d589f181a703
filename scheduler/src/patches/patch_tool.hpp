#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/pair/group_filter.hpp"
#include "core/surface/near_leaves.hpp"
#include "geometry/kept_geometry.hpp"
#include "geometry/spare_copies.hpp"
#include "objects/object_summary.hpp"
#include "pairs/pair_filter.hpp"
#include "patches/ignored_copies.hpp"
#include "patches/kept_patches.hpp"
#include "patches/patch_sources.hpp"

namespace graze {

/// An object that asks for a patch, with what a step finds near it. One task at a time, but for what says
/// otherwise.
class PatchTool {
 public:
  explicit PatchTool(Object& object) : object_(object), serial_(object.serial) {}

  [[nodiscard]] Object& object() const { return object_; }
  [[nodiscard]] std::uint64_t serial() const { return serial_; }

  /// Lists the objects whose boxes are within the radius, and that may be in a pair with the tool. Where an
  /// object is frozen at a place that its surface does not have, the radius ends before it.
  void list_near(std::span<const std::unique_ptr<Object>> objects, const ObjectSummaries& summaries,
                 const PairFilter& filter);
  /// Calls `use(object)` for each of them.
  template <typename Use>
  void visit_near(const Use& use) const {
    for (const Near& near : near_) use(*near.object);
  }
  /// Copies the tool, and finds the leaves near it of objects that are refitted. Keeps the nearest, as the
  /// most faces say.
  void find_leaves();
  /// Asks for what the patch has of each object. Stepping thread only.
  void ask(PatchSources& sources) const;
  /// Fills the patch with it.
  void fill(const PatchSources& sources, KeptPatch& patch) const;
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// An object near the tool.
  struct Near {
    Object* object = nullptr;
    PairGroups groups;
    std::shared_ptr<const GroupFilter> ignored = nullptr;
    std::size_t first_leaf = 0;  ///< in `leaves_`
    std::size_t leaf_count = 0;
  };
  /// A leaf near the tool, with the object that it is of.
  struct FoundLeaf {
    NearLeaf leaf;
    std::size_t near = 0;
    std::size_t faces = 0;
  };

  void copy_surface();
  void copy_ignored();
  void cut();
  [[nodiscard]] static bool is_there(const Near& near) {
    return near.leaf_count > 0 || near.object->settings.solid;
  }
  [[nodiscard]] std::span<const NearLeaf> leaves_of(const Near& near) const {
    return std::span(leaves_).subspan(near.first_leaf, near.leaf_count);
  }
  [[nodiscard]] KeptPatchObject kept_of(const Near& near, const PatchSources& sources) const;
  void add_faces(const Near& near, std::vector<std::uint32_t>& faces) const;

  Object& object_;
  std::uint64_t serial_;
  SpareCopies<KeptSurface> copies_;
  std::uint64_t version_ = 0;  ///< of the object's surface, at the last copy
  double threshold_ = 0;
  double known_radius_ = 0;  ///< ends before frozen objects. It is negative if the tool's place is not known
  double radius_ = 0;
  bool cut_ = false;
  std::vector<Near> near_;        ///< in the order of addition
  std::vector<NearLeaf> leaves_;  ///< of these objects, one after the other
  std::vector<FoundLeaf> found_;
  IgnoredCopies ignored_;
};

}  // namespace graze
