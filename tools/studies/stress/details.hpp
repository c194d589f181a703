#pragma once

#include <array>
#include <graze/contact.hpp>

namespace graze::tools {

/// A detail of contacts by its name in scene files.
struct NamedDetail {
  const char* name;
  ContactDetail detail;
};
inline constexpr std::array<NamedDetail, 4> timed_details = {{{"none", ContactDetail::none},
                                                              {"closest", ContactDetail::closest},
                                                              {"vertices", ContactDetail::vertices},
                                                              {"features", ContactDetail::features}}};
/// The details about surfaces.
inline constexpr std::array<NamedDetail, 4> surface_details = {{{"none", ContactDetail::none},
                                                                {"closest", ContactDetail::closest},
                                                                {"features", ContactDetail::features},
                                                                {"nearest", ContactDetail::nearest}}};

}  // namespace graze::tools
