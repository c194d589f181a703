#pragma once

/// Which sanitizers a program is built with: GCC says it by macros, clang by features.
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define GRAZE_HAS_ADDRESS_SANITIZER
#endif
#if __has_feature(thread_sanitizer)
#define GRAZE_HAS_THREAD_SANITIZER
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define GRAZE_HAS_ADDRESS_SANITIZER
#endif
#ifdef __SANITIZE_THREAD__
#define GRAZE_HAS_THREAD_SANITIZER
#endif
