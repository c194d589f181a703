#pragma once

namespace graze {

class Surface;
class VertexBlocks;

/// Throws std::logic_error where a region's bounds do not contain its vertices and the corners of the faces
/// and edges it owns. Does nothing without GRAZE_VALIDATE.
void validate(const Surface& surface);

/// Throws std::logic_error where a vertex is outside the box of its block, at the surface's present
/// positions. Does nothing without GRAZE_VALIDATE.
void validate_blocks(const Surface& surface, const VertexBlocks& blocks);

}  // namespace graze
