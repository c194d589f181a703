#pragma once

#include <array>
#include <graze/contact.hpp>
#include <graze/pair_query.hpp>
#include <graze/surface.hpp>
#include <tuple>
#include <vector>

#include "contact_name.hpp"
#include "rough_normals.hpp"
#include "working_memory.hpp"

namespace graze {

/// Normals of one surface by feature. Neighbouring contacts ask about the same features, so those that were
/// asked about last are kept.
class NormalCache {
 public:
  /// Forgets all, for another surface.
  void begin();
  /// From here on the normals found before may be replaced.
  void begin_round() { ++round_; }
  struct Found {
    RoughNormal* normal;  ///< null where one found in this round is in its place
    bool is_new;          ///< it is to be made
  };
  Found find(const FeaturePiece& piece);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.entries_);
  }
  void reserve(const PairRoom& /*room*/) { entries_.reserve(size); }

 private:
  static constexpr std::size_t size = 512;
  struct Entry {
    FeaturePiece piece;
    std::uint64_t round = 0;  ///< in which it was found last
    RoughNormal normal;
  };

  std::vector<Entry> entries_;
  std::uint64_t round_ = 0;
  std::uint64_t first_round_ = 0;  ///< of this surface
};

/// Says on which sides of two surfaces the points of contacts lie.
class Sides {
 public:
  /// For another pair; forgets what was not finished.
  void begin();
  /// Fills in the contact's sides, at the latest by finish(), until when it stays where it is.
  void add(const SurfacePair& pair, const ContactName& name, Contact& contact);
  void finish(const SurfacePair& pair);

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
  bool take(const SurfacePair& pair, const ContactName& name, Contact& contact);

  NormalCache normals_a_;
  NormalCache normals_b_;
  NormalSums sums_;
  std::array<Asked, 32> asked_{};
  std::size_t count_ = 0;
};

}  // namespace graze
