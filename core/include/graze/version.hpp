#pragma once

/// @file
/// Says which version of graze this is.

#include <array>
#include <graze/export.hpp>

/// The first number of the version of the headers. It grows when programs have to change.
#define GRAZE_VERSION_MAJOR 0
/// The second number. While the first one is 0, programs may have to change where it grows.
#define GRAZE_VERSION_MINOR 2
/// The third number. No program has to change where it grows.
#define GRAZE_VERSION_PATCH 0

namespace graze {

/// @addtogroup scene
/// @{

/// The three numbers of the version of the headers that a program is compiled with. Of two versions the older
/// one is less. In the preprocessor there are `GRAZE_VERSION_MAJOR`, `GRAZE_VERSION_MINOR` and
/// `GRAZE_VERSION_PATCH`.
inline constexpr std::array<int, 3> header_version{GRAZE_VERSION_MAJOR, GRAZE_VERSION_MINOR,
                                                   GRAZE_VERSION_PATCH};

/// Returns the version of the library that a program runs with. It may be newer than #header_version where
/// the library is shared. Any thread may call it.
[[nodiscard]] GRAZE_API std::array<int, 3> library_version() noexcept;

/// @}

}  // namespace graze
