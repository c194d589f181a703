#pragma once

/// @file
/// Defines the macro GRAZE_API.

/// @def GRAZE_API
/// Marks what a shared build of graze exports. Programs that use graze need not write it. Everything without
/// it is hidden.
#if defined(_WIN32)
#define GRAZE_API
#else
#define GRAZE_API __attribute__((visibility("default")))
#endif
