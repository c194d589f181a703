// A sequence of calls on a Scene, bad ones among them. Every step must say what a scene built afresh with the
// same positions says, whatever the objects did before.

#include "byte_reader.hpp"
#include "fuzz/scenes/scene_calls.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int most_calls = 32;
  graze::fuzz::ByteReader reader({data, size});
  graze::fuzz::SceneModel model(graze::fuzz::read_scene_settings(reader));
  for (int call = 0; call < most_calls && !reader.at_end(); ++call) graze::fuzz::make_call(reader, model);
  model.step();
  return 0;
}
