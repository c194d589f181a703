#include "mesh_summary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

std::string counts_line(const Mesh& mesh) {
  std::uint32_t quads = 0;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    quads += mesh.face(face).size() == 4 ? 1U : 0U;
  return format("%u vertices, %u faces (%u triangles, %u quads), %u edges", mesh.vertex_count(),
                mesh.face_count(), mesh.face_count() - quads, quads, mesh.edge_count());
}

/// How many of each oddity, and the number of the first.
std::string oddities_line(const Mesh& mesh) {
  const MeshOddities found = find_oddities(mesh);
  const std::pair<const char*, std::span<const std::uint32_t>> lists[] = {
      {"degenerate faces", found.degenerate_faces},
      {"duplicate faces", found.duplicate_faces},
      {"vertices without a face", found.isolated_vertices},
      {"duplicate vertices", found.duplicate_vertices},
      {"non-manifold edges", found.non_manifold_edges},
      {"border edges", found.border_edges},
      {"flipped edges", found.flipped_edges}};
  std::string line = found.closed_manifold() ? "closed" : "open or non-manifold";
  for (const auto& [name, list] : lists)
    if (!list.empty()) line += format(", %zu %s (first: %u)", list.size(), name, list.front());
  return line;
}

std::string levels_line(const RegionTree& tree) {
  std::string line;
  for (std::uint32_t level = 0; level < tree.level_count(); ++level)
    line += format("%s%u", level == 0 ? "" : ", ", tree.level_begin(level + 1) - tree.level_begin(level));
  return line + " by level";
}

std::string leaves_line(const RegionTree& tree) {
  std::uint32_t leaves = 0, least = ~std::uint32_t{0}, most = 0, vertices = 0;
  for (const Region& region : tree.regions()) {
    if (!region.is_leaf()) continue;
    ++leaves;
    vertices += region.vertex_count;
    least = std::min(least, region.vertex_count);
    most = std::max(most, region.vertex_count);
  }
  return format("; leaves: %u, of %u to %u vertices, %.1f on average", leaves, least, most,
                static_cast<double>(vertices) / leaves);
}

/// Eq. 3 at rest: for each level the largest distance from a region's middle vertex to one of its vertices.
std::string epsilon_line(const Mesh& mesh) {
  const RegionTree& tree = indexed(mesh).regions();
  std::vector<double> epsilon(tree.level_count(), 0.0);
  for (const Region& region : tree.regions())
    for (const std::uint32_t vertex : tree.vertices(region))
      epsilon[region.level] =
          std::max(epsilon[region.level], (mesh.rest()[region.middle] - mesh.rest()[vertex]).norm());
  std::string line;
  for (const double radius : epsilon) line += format("%s%.4g", line.empty() ? "" : ", ", radius);
  return line + " by level, at rest";
}

}  // namespace

std::string bounds_text(std::span<const Eigen::Vector3d> positions) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : positions) box.extend(point);
  return format("from %.6g %.6g %.6g to %.6g %.6g %.6g", box.min().x(), box.min().y(), box.min().z(),
                box.max().x(), box.max().y(), box.max().z());
}

std::string summarise_mesh(const Mesh& mesh, const std::string& indent) {
  const std::size_t bytes = mesh.byte_count();  // before more lists are made for what follows
  std::string lines;
  lines += indent + "counts     " + counts_line(mesh) + "\n";
  lines += indent + "bounds     " + bounds_text(mesh.rest()) + "\n";
  lines += indent + "surface    " + oddities_line(mesh) + "\n";
  lines += indent + "regions    " + levels_line(indexed(mesh).regions()) +
           leaves_line(indexed(mesh).regions()) + "\n";
  lines += indent + "epsilon    " + epsilon_line(mesh) + "\n";
  lines += indent + "memory     " +
           format("%zu bytes, %zu of them regions, %.0f a vertex", bytes,
                  indexed(mesh).regions().byte_count(), static_cast<double>(bytes) / mesh.vertex_count()) +
           "\n";
  return lines;
}

}  // namespace graze::tools
