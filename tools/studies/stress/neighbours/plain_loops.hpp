#pragma once

#include <graze/mesh.hpp>

namespace graze::tools {

/// The milliseconds that plain loops take for the distances of all vertices of one mesh and faces of the
/// other, and of all pairs of edges, of two bodies of one mesh of triangles that are 10^-6 apart. It is the
/// least of some runs.
double plain_loops_ms(const Mesh& mesh);

}  // namespace graze::tools
