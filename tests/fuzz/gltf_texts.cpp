#include "gltf_texts.hpp"

namespace graze::fuzz {

std::vector<std::string> gltf_texts() {
  return {
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
