#pragma once

#include <graze/contact.hpp>
#include <span>

#include "base/working_memory.hpp"
#include "kernels/measure.hpp"
#include "measure/sides.hpp"
#include "names/contact_name.hpp"

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

/// `measure` of each name into the contact at its place, several at once.
void measure(const SurfacePair& pair, std::span<const ContactName> names, std::span<Contact> contacts,
             MeasureScratch& scratch);

}  // namespace graze
