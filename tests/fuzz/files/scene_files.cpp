#include "scene_files.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace graze::fuzz {
namespace {

constexpr const char* plate_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
constexpr const char* pair_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng left\nf 1 2 3\ng right\nf 1 3 4\n";
constexpr const char* solid_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr const char* tent_ply =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0.5\n1 0 0.5\n0.5 1 -0.25\n0 2 0.5\nnan nan nan\n3 0 1 2\n3 0 2 3\n";
/// One triangle whose node turns about z in a second.
constexpr const char* turning_gltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"name":"wing"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"animations":[{"name":"turn","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
"samplers":[{"input":1,"output":2}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},
{"buffer":0,"byteOffset":44,"byteLength":24}],
"buffers":[{"byteLength":68,"uri":"data:application/octet-stream;base64,)"
                                     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAA"
                                     R"(AAAAAAAAAAAAAAAAAAAAgD8="}]})";

void append(std::string& bytes, std::uint32_t word, bool is_big_endian) {
  for (unsigned i = 0; i < 4; ++i)
    bytes += static_cast<char>((word >> (8 * (is_big_endian ? 3 - i : i))) & 0xFFU);
}

}  // namespace

std::string cache_seed(bool is_pc2, std::uint32_t vertices, std::uint32_t frames) {
  std::string bytes;
  if (is_pc2) {
    bytes.assign("POINTCACHE2\0", 12);
    for (const std::uint32_t word :
         {1U, vertices, std::bit_cast<std::uint32_t>(0.0F), std::bit_cast<std::uint32_t>(1.0F), frames})
      append(bytes, word, false);
  } else {
    append(bytes, frames, true);
    append(bytes, vertices, true);
    for (std::uint32_t frame = 0; frame < frames; ++frame)
      append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(frame)), true);
  }
  for (std::uint32_t i = 0; i < 3 * vertices * frames; ++i)
    append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(i % 7) / 4), !is_pc2);
  return bytes;
}

void write_scene_files(const tests::TemporaryFolder& folder) {
  folder.write("plate.obj", plate_obj);
  folder.write("pair.obj", pair_obj);
  folder.write("solid.obj", solid_obj);
  folder.write("tent.ply", tent_ply);
  for (int frame = 1; frame <= 3; ++frame)
    folder.write("plate_" + std::to_string(frame) + ".off",
                 "OFF\n4 0 0\n0 0 0\n1 0 0\n1 1 " + std::to_string(frame) + "\n0 1 0.5\n");
  folder.write("plate.pc2", cache_seed(true, 4, 3));
  folder.write("plate.mdd", cache_seed(false, 4, 2));
  folder.write("turning.gltf", turning_gltf);
}

std::vector<std::string> scene_file_seeds() {
  return {
      R"({"graze": 1, "contact_distance": 0.25, "range": 1, "objects": [{"mesh": "plate.obj"},
 {"name": "tent", "mesh": "tent.ply", "poses": [{"frame": 0}, {"frame": 4, "translate": [0, 0, 1],
 "rotate_degrees": [0, 90, 30]}]}]})",
      R"({"graze": 1, "range": "infinity", "detail": "vertices", "accuracy": {"paper": [2, 1, 0.5]}, "frames": 3,
 "frames_per_second": 24, "objects": [{"name": "a", "mesh": "turning.gltf", "animation": "turn"},
 {"name": "b", "mesh": "plate.obj", "positions": "plate_#.off", "kind": 3}],
 "rules": [{"kinds": [0, 3], "contact_distance": 0.5, "range": 2, "epsilon": [1]}]})",
      R"({"graze": 1, "detail": "closest", "accuracy": {"within": 0.125}, "objects": [
 {"name": "both", "mesh": "pair.obj", "motion": "fixed", "layer": 2, "collides_with": 4294967295},
 {"mesh": "plate.obj", "node": 0, "motion": "deformable", "positions": "plate.pc2", "margin": 0.5,
 "transform": {"translate": [0, 0, 0.1], "rotate_degrees": [0, 0, 45], "scale": 0.5}},
 {"name": "c", "mesh": "plate.obj", "positions": "plate.mdd", "collides_with": 3}],
 "ignore": [["both", "both"], ["both/left", "c"]]})",
      R"({"graze": 1, "contact_distance": 0.25, "detail": "nearest", "max_contacts": 9, "max_contacts_per_pair": 4,
 "ways_out": true, "carrying": 3, "carrying_band": 0.125,
 "objects": [{"name": "a", "mesh": "solid.obj", "solid": true, "motion": "deformable"},
 {"name": "b", "mesh": "solid.obj", "solid": true, "transform": {"translate": [0.1, 0.1, 0.1], "scale": 0.25}},
 {"name": "c", "mesh": "tent.ply", "face_groups": [0, 1], "hidden_groups": [1], "queries": true, "patch_radius": 0.5, "patch_faces": 64}, {"name": "d", "mesh": "pair.obj", "node": "left",
 "face_groups": [255]}], "ignore": [["c", 1, "d", 255]]})",
      R"({"graze": 1, "contact_distance": 0.125, "sweep_tolerance": 1e-9, "swept_gap": 0.25,
 "objects": [{"name": "a", "mesh": "plate.obj", "positions": "plate_#.off", "self": true, "self_rings": 0,
 "self_at_rest": true, "swept": true}, {"name": "b", "mesh": "tent.ply", "face_groups": [0, 1], "self": true,
 "self_rings": 8, "swept": true, "poses": [{"frame": 0}, {"frame": 2, "translate": [0, 0, 1]}]}],
 "ignore": [["b", 0, "b", 1]]})",
      R"({"graze": 1, "detail": "regions", "outside_files": true, "objects": [{"mesh": "tent.ply", "transform": {"scale": 1e300}}]})"};
}

}  // namespace graze::fuzz
