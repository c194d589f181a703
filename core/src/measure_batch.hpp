#pragma once

#include <graze/contact.hpp>
#include <span>
#include <vector>

#include "contact_name.hpp"
#include "kernels/measure.hpp"
#include "working_memory.hpp"

namespace graze {

/// The weighted normals of features of one surface that were asked for last; neighbouring contacts ask for
/// the same.
class NormalCache {
 public:
  void begin();
  /// `weighted_normal` of the piece.
  const Eigen::Vector3d& of(const Surface& surface, const FeaturePiece& piece, DecisionCount& count);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.entries_);
  }
  void reserve(const PairRoom& /*room*/) { entries_.reserve(size); }

 private:
  static constexpr std::size_t size = 512;
  struct Entry {
    FeaturePiece piece;
    std::uint32_t generation = 0;  ///< in which it was made
    Eigen::Vector3d normal;
  };

  std::vector<Entry> entries_;
  std::uint32_t generation_ = 0;
};

struct MeasureScratch {
  kernels::ContactBatch batch{};
  NormalCache normals_a;
  NormalCache normals_b;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.normals_a, self.normals_b);
  }
};

/// `measure` of each name into the contact at its place, several at once.
void measure(const SurfacePair& pair, std::span<const ContactName> names, std::span<Contact> contacts,
             MeasureScratch& scratch);

}  // namespace graze
