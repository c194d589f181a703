#pragma once

#include <cstdint>
#include <span>

namespace graze {

struct Box;
class Surface;

/// Throws std::logic_error where a vertex that is not listed is nearer than `reach` to a box along every
/// axis. Does nothing without GRAZE_VALIDATE.
void validate_near_part(const Surface& surface, const Box& box, double reach,
                        std::span<const std::uint32_t> listed);

}  // namespace graze
