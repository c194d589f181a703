#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/kept_by_reports.hpp"
#include "base/slot_pair.hpp"
#include "core/base/box.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A copy of an object's surface as a step saw it, refitted for faces. It does not change while a report
/// shows it.
struct KeptSurface {
  explicit KeptSurface(std::shared_ptr<const Mesh> of) : mesh(std::move(of)), surface(mesh) {}

  std::shared_ptr<const Mesh> mesh;
  Surface surface;
};

/// An object that asks for queries, as a step saw it.
struct KeptObject {
  ObjectId id;
  std::uint64_t serial = 0;  ///< ascends in the order of addition
  std::uint32_t layer = 0;
  std::uint32_t collides_with = 0;
  bool solid = false;
  std::shared_ptr<const KeptSurface> surface;
  std::shared_ptr<const FaceGroups> groups;  ///< null if no face is hidden
};

/// The objects of a report that ask for queries, with a tree of their boxes. Reports share it. It does not
/// change while one of them has it.
class KeptGeometry final : public KeptByReports {
 public:
  /// Takes objects, ascending by serial, and builds the tree. `order` has their indices in groups of eight,
  /// with no_slot where there is none (BoxOrder). The list that it had before comes back in `objects`.
  void fill(std::vector<KeptObject>& objects, std::span<const std::uint32_t> order);

  /// Lets go of the objects.
  void clear() { objects_.clear(); }

  [[nodiscard]] std::span<const KeptObject> objects() const { return objects_; }
  /// The object of an id, or null.
  [[nodiscard]] const KeptObject* find(ObjectId id) const;
  [[nodiscard]] std::size_t byte_count() const;

  /// Visits objects by `use(object)`, first those whose boxes have the lowest `lower(box)`. `limit()` is what
  /// that may be at most. It may fall. Infinity is beyond every limit.
  template <typename Lower, typename Limit, typename Use>
  void visit_nearest_first(const Lower& lower, const Limit& limit, const Use& use) const;

 private:
  static constexpr std::uint32_t width = 8;
  static constexpr std::size_t most_levels = 12;  ///< 8^11 is more than there can be objects

  struct Open {
    double lower;
    std::uint32_t level;
    std::uint32_t index;
  };

  std::vector<KeptObject> objects_;
  std::vector<std::uint32_t> index_of_slot_;  ///< by ObjectId::index, or no_slot
  std::vector<std::uint32_t> object_of_leaf_;
  std::vector<std::vector<Box>> levels_;  ///< of the leaves, of eight leaves each, …, of the root
  std::size_t level_count_ = 0;
};

template <typename Lower, typename Limit, typename Use>
void KeptGeometry::visit_nearest_first(const Lower& lower, const Limit& limit, const Use& use) const {
  if (objects_.empty()) return;
  std::array<Open, most_levels * width> open;
  std::size_t count = 0;
  const auto add = [&](std::uint32_t level, std::uint32_t index, std::size_t first) {
    const double value = lower(levels_[level][index]);
    if (!(value < std::numeric_limits<double>::infinity()) || value > limit()) return;
    // Sorts siblings, the nearest last.
    std::size_t place = count++;
    for (; place > first && open[place - 1].lower < value; --place) open[place] = open[place - 1];
    open[place] = {value, level, index};
  };
  add(static_cast<std::uint32_t>(level_count_ - 1), 0, 0);
  while (count > 0) {
    const Open next = open[--count];
    if (next.lower > limit()) continue;
    if (next.level == 0) {
      use(objects_[object_of_leaf_[next.index]]);
      continue;
    }
    const std::size_t first = count;
    const std::size_t end = levels_[next.level - 1].size();
    for (std::size_t child = std::size_t{next.index} * width; child < (next.index + std::size_t{1}) * width;
         ++child)
      if (child < end) add(next.level - 1, static_cast<std::uint32_t>(child), first);
  }
}

}  // namespace graze
