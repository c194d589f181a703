#include "core/mesh/closed.hpp"

namespace graze {
namespace {

/// How many faces have an edge, and how often it is passed from its lower vertex to the higher one.
struct Passes {
  std::size_t faces = 0;
  std::size_t all = 0;
  std::size_t upward = 0;
};

Passes passes_of(const IndexedMesh& mesh, std::uint32_t edge) {
  Passes passes;
  for (const std::uint32_t face : mesh.edge_faces(edge)) {
    ++passes.faces;
    const auto edges = mesh.face_edges(face);
    for (std::size_t corner = 0; corner < edges.size(); ++corner) {
      if (edges[corner] != edge) continue;
      ++passes.all;
      if (mesh.face(face)[corner] == mesh.edge(edge)[0]) ++passes.upward;
    }
  }
  return passes;
}

}  // namespace

std::optional<std::string> why_not_closed(const IndexedMesh& mesh) {
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) {
    const Passes passes = passes_of(mesh, edge);
    if (passes.faces == 2 && passes.all == 2 && passes.upward == 1) continue;
    const auto [first, second] = mesh.edge(edge);
    const std::string name =
        "the edge of vertices " + std::to_string(first) + " and " + std::to_string(second);
    if (passes.faces != 2)
      return name + " has " + std::to_string(passes.faces) + (passes.faces == 1 ? " face" : " faces") +
             " instead of two";
    return name + " has two faces that pass it in the same direction";
  }
  return std::nullopt;
}

}  // namespace graze
