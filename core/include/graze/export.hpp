#pragma once

/// Marks what a shared build of graze exports. Everything else is hidden.
#if defined(_WIN32)
#define GRAZE_API
#else
#define GRAZE_API __attribute__((visibility("default")))
#endif
