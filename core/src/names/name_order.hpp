#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "names/contact_name.hpp"

namespace graze {

/// Sorts names. Long lists are sorted digit by digit as numbers that hold all of a name, which takes the same
/// few steps for each whatever their order.
class NameOrder {
 public:
  void sort(std::span<ContactName> names);
  /// Makes room to sort so many before a deadline, where there is one. Throws TimeIsUp.
  void make_room(std::size_t count, TimeLimit* time);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.keys_, self.spare_);
  }
  void reserve(const PairRoom& room) {
    for (auto* const keys : {&keys_, &spare_}) keys->reserve(names_of_contact * room.contacts);
  }

 private:
  void sort_keys();

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> spare_;
};

}  // namespace graze
