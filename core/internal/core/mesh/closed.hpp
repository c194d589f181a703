#pragma once

#include <graze/export.hpp>
#include <optional>
#include <string>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// Returns nothing for a closed surface: each edge has two faces, which pass it in opposite directions.
/// Otherwise it names the first edge where that is not so, for people.
[[nodiscard]] GRAZE_API std::optional<std::string> why_not_closed(const IndexedMesh& mesh);

}  // namespace graze
