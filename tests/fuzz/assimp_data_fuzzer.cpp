// The conversion of what assimp hands over, down to meshes and animated positions: a scene in memory is built
// from the bytes, and no file is read.

#include "assimp/assimp_scene.hpp"
#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/files/assimp_scene_builder.hpp"
#include "fuzz/files/rig_checks.hpp"

namespace graze::fuzz {
namespace {

void run(ByteReader reader) {
  const std::filesystem::path path = reader.flag() ? "scene.dae" : "scene.fbx";
  const auto scene = build_assimp_scene(reader);
  io::RiggedFile file;
  if (!accepts([&] { file = io::convert_scene(path, *scene); })) return;
  check_rigged_file(file);
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
