#include "rig_checks.hpp"

#include <cmath>

#include "fuzz/finding.hpp"

namespace graze::fuzz {
namespace {

using io::Body;
using io::Rig;

template <typename Value>
void check(const io::Track<Value>& track) {
  expect(track.seconds.size() == track.values.size(), "not one value a key");
  const std::size_t tangents = track.interpolation == io::Interpolation::cubic ? track.values.size() : 0;
  expect(track.in_tangents.size() == tangents && track.out_tangents.size() == tangents,
         "not two tangents a key");
  for (std::size_t i = 0; i < track.seconds.size(); ++i)
    expect(std::isfinite(track.seconds[i]) && (i == 0 || track.seconds[i - 1] <= track.seconds[i]),
           "keys out of order");
}

void check(const io::Clip& clip, const Rig& rig) {
  expect(clip.seconds >= 0 && std::isfinite(clip.seconds), "an animation of no proper length");
  for (const auto& [node, motion] : clip.node_motions) {
    expect(node < rig.nodes.size(), "an animation of a node that is not there");
    check(motion.translation);
    check(motion.rotation);
    check(motion.scale);
  }
  for (const auto& [node, tracks] : clip.morph_weights)
    for (const auto& track : tracks) check(track);
}

void check(const Body& body, const Rig& rig) {
  expect(body.node < rig.nodes.size(), "a body of a node that is not there");
  for (const auto& target : body.targets)
    expect(target.offsets.size() == body.vertices.size(), "not one offset a vertex");
  expect(body.bones.empty() || body.influences.size() == body.vertices.size(), "influences of no vertex");
  for (const auto& influences : body.influences)
    for (const auto& influence : influences)
      expect(influence.bone < body.bones.size() && influence.weight > 0, "an influence of no bone");
}

/// The surface becomes a mesh, or is refused for a position.
void check(io::RawSurface surface, std::size_t vertex_count) {
  expect(surface.positions.size() == vertex_count, "not one position a vertex");
  std::size_t triangles = 0;
  for (const std::uint32_t count : surface.corner_counts) triangles += count <= 4 ? 1 : count - 2;
  for (const std::uint32_t corner : surface.corners)
    expect(corner < vertex_count, "a corner that names no vertex");
  io::cut_large_faces(surface);
  expect(surface.corner_counts.size() == triangles, "a cut face has another number of triangles");
  accepts([&] {
    const auto mesh = io::make_mesh("scene", "object", surface);
    expect(mesh->face_count() == triangles, "the mesh has another number of faces");
  });
}

void check_poses(const Rig& rig, const Body& body) {
  std::vector<Eigen::Vector3d> positions;
  const bool is_moved = io::MovedNodes(rig).move(body);
  expect(!is_moved || !rig.clips.empty(), "a body that moves without an animation");
  for (const io::Clip& clip : rig.clips) {
    for (const double part : {0.0, 0.3, 1.0}) {
      io::pose(rig, body, &clip, part * clip.seconds, positions);
      expect(positions.size() == body.vertices.size(), "a pose of another number of vertices");
    }
  }
}

}  // namespace

void check_rigged_file(const io::RiggedFile& file) {
  const Rig& rig = file.rig;
  expect(rig.bodies.size() == file.file.objects.size(), "not one body an object");
  for (std::size_t node = 0; node < rig.nodes.size(); ++node)
    expect(rig.nodes[node].parent == io::RigNode::no_parent || rig.nodes[node].parent < node,
           "a node before its parent");
  for (const io::Clip& clip : rig.clips) check(clip, rig);
  for (std::size_t i = 0; i < rig.bodies.size(); ++i) {
    check(rig.bodies[i], rig);
    check(file.file.objects[i].surface, rig.bodies[i].vertices.size());
    check_poses(rig, rig.bodies[i]);
  }
}

}  // namespace graze::fuzz
