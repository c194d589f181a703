#pragma once

#include <algorithm>
#include <array>
#include <graze/enumerators.hpp>

namespace graze::tests {

/// Every detail. A test that is about all of them goes through these, so that it meets new ones.
inline constexpr auto all_details = enumerators<ContactDetail>;

/// Whether the distances of a detail are between surfaces, and not between vertices.
constexpr bool is_about_surfaces(ContactDetail detail) {
  return detail != ContactDetail::regions && detail != ContactDetail::vertices;
}

/// Every detail whose distances are between surfaces.
inline constexpr auto surface_details = [] {
  std::array<ContactDetail, std::ranges::count_if(all_details, is_about_surfaces)> some{};
  std::ranges::copy_if(all_details, some.begin(), is_about_surfaces);
  return some;
}();

}  // namespace graze::tests
