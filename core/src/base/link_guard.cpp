#include <graze/link_guard.hpp>

#if defined(__GLIBCXX__)

namespace graze::link_guard {

const char GRAZE_CONTAINERS = 0;
const char GRAZE_STRINGS = 0;

}  // namespace graze::link_guard

#endif
