#pragma once

#include <algorithm>
#include <array>
#include <graze/contact.hpp>
#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"
#include "measure/rough_normals.hpp"

namespace graze {

/// Normals of one surface by feature. Neighbouring contacts ask about the same features, so those that were
/// asked about last are kept.
class NormalCache {
 public:
  /// How many features asked about in a row are certainly kept, until the next.
  static constexpr std::size_t at_once = 128;

  /// Forgets all, for another surface.
  void begin();
  /// From here on the normals found before may be replaced.
  void begin_round() {
    oldest_ = std::max(first_, next_ + at_once - std::min<std::uint64_t>(next_ + at_once, size));
  }
  struct Found {
    RoughNormal* normal;
    bool is_new;  ///< it is to be made
  };
  Found find(const FeaturePiece& piece) {
    const auto kind = static_cast<std::uint32_t>(piece.feature.kind);
    const std::uint64_t key =
        std::uint64_t{piece.feature.index} << 4U | kind << 2U | static_cast<std::uint32_t>(piece.piece);
    Entry& entry = entries_[(std::size_t{piece.feature.index} * 3 + kind) % size];
    const bool is_new = entry.key != key || entry.number < oldest_;
    if (is_new) entry = {key, next_++};
    return {&normals_[entry.number % size], is_new};
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.entries_, self.normals_);
  }
  void reserve(const PairRoom& /*room*/) {
    entries_.reserve(size);
    normals_.reserve(size);
  }

 private:
  static constexpr std::size_t size = 512;
  struct Entry {
    std::uint64_t key = 0;
    std::uint64_t number = 0;  ///< of the normal, in the order in which they are made
  };

  std::vector<Entry> entries_;
  std::vector<RoughNormal> normals_;  ///< the last ones, by their number
  std::uint64_t next_ = 1;
  std::uint64_t first_ = 1;   ///< of this surface
  std::uint64_t oldest_ = 1;  ///< that is not replaced in this round
};

/// Says on which sides of two surfaces the points of contacts lie.
class Sides {
 public:
  /// For another pair. Forgets what was not finished.
  void begin();
  /// Fills in the contact's sides, at the latest by finish(), until when it stays where it is.
  void add(const SurfacePair& pair, const FeaturePairKey& key, Contact& contact);
  void finish(const SurfacePair& pair);

  /// The normal at a vertex, as from the next `finish_normals` until the next `begin_normals`, between which
  /// no more are asked for than are kept.
  void begin_normals();
  const RoughNormal* normal_of_a(const SurfacePair& pair, std::uint32_t vertex) {
    return normal_of(pair.a, vertex, normals_a_);
  }
  const RoughNormal* normal_of_b(const SurfacePair& pair, std::uint32_t vertex) {
    return normal_of(pair.b, vertex, normals_b_);
  }
  void finish_normals() { sums_.finish(); }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.normals_a_, self.normals_b_);
  }

 private:
  struct Asked {
    FeaturePiece a, b;
    Contact* contact;
    const RoughNormal* normal_a;
    const RoughNormal* normal_b;
  };

  const RoughNormal* normal_of(const Surface& surface, std::uint32_t vertex, NormalCache& normals) {
    const auto [normal, is_new] = normals.find(vertex_piece(vertex));
    if (is_new) sums_.add_vertex(surface, vertex, *normal);
    return normal;
  }

  NormalCache normals_a_;
  NormalCache normals_b_;
  NormalSums sums_;
  std::array<Asked, 32> asked_{};
  std::size_t count_ = 0;
};

}  // namespace graze
