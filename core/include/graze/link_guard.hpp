#pragma once

/// @file
/// Stops the linker where a program and graze were built for two forms of the standard library's types.

#include <graze/export.hpp>
#include <string>

/// @cond internal

// GCC's standard library has two forms of std::string and two of its containers. A program and a library that
// pass them to each other must have the same. The linker does not see it for structs such as ObjectSettings,
// and the program then crashes. So every file that includes graze asks for a symbol that only a graze of the
// same form has. The name of the symbol that is missing says what to change.
#if defined(__GLIBCXX__)

#if defined(_GLIBCXX_DEBUG)
#define GRAZE_CONTAINERS program_and_graze_both_need__GLIBCXX_DEBUG
#else
#define GRAZE_CONTAINERS program_and_graze_both_built_without__GLIBCXX_DEBUG
#endif
#if _GLIBCXX_USE_CXX11_ABI
#define GRAZE_STRINGS program_and_graze_both_need__GLIBCXX_USE_CXX11_ABI_1
#else
#define GRAZE_STRINGS program_and_graze_both_need__GLIBCXX_USE_CXX11_ABI_0
#endif

namespace graze::link_guard {

extern GRAZE_API const char GRAZE_CONTAINERS;
extern GRAZE_API const char GRAZE_STRINGS;

[[gnu::used]] inline const char* const containers = &GRAZE_CONTAINERS;
[[gnu::used]] inline const char* const strings = &GRAZE_STRINGS;

}  // namespace graze::link_guard

#endif

/// @endcond
