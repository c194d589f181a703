#pragma once

#include <graze/contact.hpp>
#include <span>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "kernels/measure.hpp"
#include "measure/sides.hpp"

namespace graze {

struct MeasureScratch {
  kernels::ContactBatch batch{};
  kernels::VertexBatch vertices{};
  Sides sides;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.sides);
  }
};

/// Measures each key into the contact at its index, several at once.
void measure(const SurfacePair& pair, std::span<const FeaturePairKey> keys, std::span<Contact> contacts,
             MeasureScratch& scratch);

}  // namespace graze
