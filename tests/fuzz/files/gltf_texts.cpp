#include "gltf_texts.hpp"

namespace graze::fuzz {

namespace {

/// Views of 48 bytes each over a buffer of zeros, and accessors of the standard's types over them.
std::string data(std::size_t view_count) {
  std::string views;
  for (std::size_t i = 0; i < view_count; ++i)
    views += (i == 0 ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") + std::to_string(48 * i) +
             R"(,"byteLength":)" + (i + 1 == view_count ? "128}" : "48}");
  return R"("bufferViews":[)" + views + R"(],"buffers":[{"byteLength":)" +
         std::to_string(48 * view_count + 96) + R"(,"uri":"data:application/octet-stream;base64,)" +
         std::string(64 * view_count + 128, 'A') + R"("}])";
}

/// Every part of the format that is read.
std::string whole_file() {
  return R"({"asset":{"version":"2.0"},"scene":1,"scenes":[{"nodes":[]},{"name":"s","nodes":[0,1]}],
"nodes":[{"mesh":0,"skin":0,"weights":[0.5],"name":"a"},{"children":[2,3],"translation":[0,0,1],"scale":[-1,1,1]},
{"rotation":[0,0,0,1],"mesh":1,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,"SCALE":0}}}},
{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],
"meshes":[{"name":"m","weights":[1],"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3,
"targets":[{"POSITION":4}]}]},{"primitives":[{"mode":5,"attributes":{"POSITION":5}},
{"mode":6,"indices":3,"attributes":{"POSITION":5}},{"mode":1,"attributes":{"POSITION":5}}]}],
"skins":[{"joints":[1,3],"inverseBindMatrices":6},{"joints":[2]}],
"animations":[{"name":"x","channels":[{"sampler":0,"target":{"node":0,"path":"weights"}},
{"sampler":1,"target":{"node":3,"path":"rotation"}},{"sampler":2,"target":{"node":1,"path":"translation"}}],
"samplers":[{"input":7,"output":7,"interpolation":"STEP"},{"input":8,"output":9,"interpolation":"CUBICSPLINE"},
{"input":8,"output":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"},
{"bufferView":2,"componentType":5123,"normalized":true,"count":4,"type":"VEC4"},
{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"},
{"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},
"values":{"bufferView":0,"byteOffset":4}}},
{"bufferView":0,"componentType":5122,"normalized":true,"count":4,"type":"VEC3","byteOffset":2},
{"bufferView":6,"componentType":5126,"count":2,"type":"MAT4"},
{"bufferView":5,"componentType":5126,"count":3,"type":"SCALAR"},
{"bufferView":5,"componentType":5126,"count":1,"type":"SCALAR"},
{"bufferView":2,"componentType":5120,"normalized":true,"count":3,"type":"VEC4"}],
"extensionsRequired":["EXT_mesh_gpu_instancing","KHR_mesh_quantization"],)" +
         data(7) + "}";
}

}  // namespace

std::vector<std::string> gltf_texts() {
  return {whole_file(),
          R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"name":"a","mesh":0,"skin":0,"weights":[0.5]},
{"name":"a","children":[0]}],"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0,"WEIGHTS_0":1},
"indices":2,"targets":[{"POSITION":0}]},{"mode":5,"attributes":{"POSITION":0}}]}],"skins":[{"joints":[0,2]}],
"animations":[{"channels":[{"sampler":0,"target":{"node":1,"path":"weights"}},
{"sampler":1,"target":{"node":2,"path":"rotation"}}],"samplers":[{"input":3,"output":3,"interpolation":"STEP"},
{"input":3,"output":4,"interpolation":"CUBICSPLINE"}]}],
"accessors":[{"componentType":5126,"count":4,"type":"VEC3","bufferView":0},
{"componentType":5126,"count":4,"type":"VEC4"},{"componentType":5123,"count":6,"type":"SCALAR"},
{"componentType":5126,"count":1,"type":"SCALAR"},
{"componentType":5126,"count":3,"type":"VEC4","sparse":{"count":1}}],
"bufferViews":[{"buffer":0,"byteLength":48}],"buffers":[{"byteLength":48}]})",
          R"({"nodes":[{"name":"n","mesh":0}],"meshes":[{"primitives":[{"mode":0,"attributes":{}},
{"mode":4,"attributes":{"POSITION":0}}]}],"skins":[{"joints":[0],"inverseBindMatrices":1}],
"accessors":[{"count":7,"componentType":5126},{"count":1,"componentType":5126}]})"};
}

}  // namespace graze::fuzz
