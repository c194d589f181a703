#pragma once

#include <algorithm>
#include <vector>

#include "core/mesh/pair_room.hpp"
#include "leaves/layout/leaf_features.hpp"

namespace graze {

/// The features of the leaves that a query tested last. A leaf is met beside several others.
class LeafCache {
 public:
  /// Begins with this surface where it is now, in this frame.
  void begin(const Surface& surface, const FilterFrame& frame, bool vertices_only) {
    const bool same = surface_ == surface.serial() && version_ == surface.version() && frame_ == frame &&
                      vertices_only_ == vertices_only;
    if (same) return;
    surface_ = surface.serial();
    version_ = surface.version();
    frame_ = frame;
    vertices_only_ = vertices_only;
    for (Slot& slot : slots_) slot.leaf = nullptr;
  }

  /// All features of a leaf of that surface. They stay until the next call. `corners` is working memory.
  const LeafFeatures& of(const Surface& surface, const Region& leaf, LeafVertices& corners) {
    make_room(leaf);
    const std::size_t number = surface.mesh().regions().number(leaf);
    Slot& slot = slots_[number % slot_count];
    if (slot.leaf != &leaf) {
      slot.leaf = &leaf;
      if (vertices_only_)
        slot.features.collect_vertices(surface, leaf, frame_, corners);
      else
        slot.features.collect(surface, leaf, frame_, corners);
    }
    return slot.features;
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.slots_);
  }
  void reserve_as(const LeafCache& other) {
    if (!other.slots_.empty()) reserve(other.room_);
  }
  /// Every slot has room for the largest leaf so far, since which leaf goes into which slot is a matter of
  /// chance.
  void reserve(const PairRoom& room) {
    const auto make = [](std::size_t& have, std::size_t count) {
      have = std::max(have, std::min(count, most_everywhere));
    };
    make(room_.leaf_vertices, room.leaf_vertices);
    make(room_.leaf_edges, room.leaf_edges);
    make(room_.leaf_faces, room.leaf_faces);
    slots_.resize(slot_count);
    for (Slot& slot : slots_) slot.features.reserve(room_);
  }
  [[nodiscard]] std::size_t bytes_of() const {
    std::size_t bytes = graze::bytes_of(slots_);
    for (const Slot& slot : slots_) bytes += graze::bytes_of(slot.features);
    return bytes;
  }

 private:
  void make_room(const Region& leaf) {
    const auto fits = [](std::size_t room, std::uint32_t count) {
      return room >= std::min<std::size_t>(count, most_everywhere);
    };
    const bool enough = fits(room_.leaf_vertices, leaf.vertex_count) &&
                        (vertices_only_ || (fits(room_.leaf_edges, leaf.edge_count) &&
                                            fits(room_.leaf_faces, leaf.face_count)));
    if (enough && !slots_.empty()) return;
    PairRoom room;
    room.leaf_vertices = leaf.vertex_count;
    if (!vertices_only_) {
      room.leaf_edges = leaf.edge_count;
      room.leaf_faces = leaf.face_count;
    }
    reserve(room);
  }

  /// A leaf of more features of a kind, as coincident vertices make, takes more room in its own slot alone.
  static constexpr std::size_t most_everywhere = 512;
  /// A leaf has one slot only. Leaves beside each other have numbers beside each other. More slots find few
  /// more leaves, and take time to empty and room in the processor's cache (docs/tried.md).
  static constexpr std::size_t slot_count = 16;
  struct Slot {
    const Region* leaf = nullptr;
    LeafFeatures features;
  };

  std::uint64_t surface_ = 0;
  std::uint64_t version_ = 0;
  FilterFrame frame_;
  bool vertices_only_ = false;
  PairRoom room_;  ///< for the largest leaf
  std::vector<Slot> slots_;
};

}  // namespace graze
