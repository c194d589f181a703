#pragma once

#include <graze/contact.hpp>
#include <span>
#include <vector>

#include "contact_name.hpp"
#include "kernels/measure.hpp"
#include "normals.hpp"
#include "working_memory.hpp"

namespace graze {

/// Says on which side of one surface points lie. Neighbouring contacts ask about the same features, so the
/// normals of those that were asked about last are kept.
class Sides {
 public:
  void begin();
  /// `side_of` for a unit vector.
  Side of(const Surface& surface, const FeaturePiece& piece, const Eigen::Vector3d& direction,
          DecisionCount& count);

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
    RoughNormal normal;
  };

  std::vector<Entry> entries_;
  std::uint32_t generation_ = 0;
};

struct MeasureScratch {
  kernels::ContactBatch batch{};
  Sides sides_a;
  Sides sides_b;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.sides_a, self.sides_b);
  }
};

/// `measure` of each name into the contact at its place, several at once.
void measure(const SurfacePair& pair, std::span<const ContactName> names, std::span<Contact> contacts,
             MeasureScratch& scratch);

}  // namespace graze
