// What is done to a glTF file before assimp sees it: bytes are refused or prepared, and what was prepared is
// prepared. The first byte chooses between .gltf and .glb, the rest is the file.

#include "byte_reader.hpp"
#include "finding.hpp"
#include "gltf_source.hpp"
#include "input_folder.hpp"

namespace graze::fuzz {
namespace {

void run(ByteReader reader) {
  const std::string name = reader.flag() ? "file.glb" : "file.gltf";
  const auto path = write_input(name, reader.rest());
  std::optional<io::GltfSource> source;
  if (!accepts([&] { source = io::prepare_gltf(path); }) || !source) return;
  for (const auto& [mesh, primitive] : source->primitives)
    expect(!mesh.empty() && !primitive.place.empty(), "a primitive without a name or place");
  for (const std::string& warning : source->warnings)
    expect(warning.find('\n') == std::string::npos, "a warning of several lines");

  const auto again_path = input_folder().write(name, source->bytes);
  std::optional<io::GltfSource> again;
  expect(accepts([&] { again = io::prepare_gltf(again_path); }), "what was prepared is refused");
  expect(again.has_value(), "what was prepared is taken for glTF 1");
  expect(again->bytes == source->bytes, "preparing what was prepared changes it");
  expect(again->steps == source->steps, "preparing what was prepared changes its steps");
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
