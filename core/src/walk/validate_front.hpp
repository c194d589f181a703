#pragma once

namespace graze {

struct LeafFront;
class Surface;

/// Throws std::logic_error where a pair of leaves outside a front that is about surfaces is nearer than the
/// front says. Checks small surfaces only. Does nothing without GRAZE_VALIDATE.
void validate(const LeafFront& front, const Surface& a, const Surface& b);

}  // namespace graze
