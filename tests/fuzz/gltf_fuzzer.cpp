// A glTF file of any bytes is read or refused. What is read has indices in range, keys in order, and objects
// that become meshes and poses. The first byte chooses between .gltf and .glb, the rest is the file.

#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/files/rig_checks.hpp"
#include "gltf/gltf_document.hpp"
#include "gltf/read_gltf.hpp"
#include "input_folder.hpp"

namespace graze::fuzz {
namespace {

void run(ByteReader reader) {
  const auto path = write_input(reader.flag() ? "file.glb" : "file.gltf", reader.rest());
  io::RiggedFile file;
  bool is_version_1 = false;
  // Version 1 is read by assimp, which is not fuzzed.
  if (!accepts([&] { is_version_1 = io::GltfDocument(path).is_version_1(); }) || is_version_1) return;
  if (!accepts([&] { file = io::read_gltf(path); })) return;
  check_rigged_file(file);
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
