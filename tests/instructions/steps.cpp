// Steps whose instructions are counted: `graze_counted_steps SCENE DETAIL INSTRUCTION_SET` plays four frames
// of a scene on one thread. Exits 77 where the processor does not have the instruction set.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <graze/enumerators.hpp>
#include <graze/graze.hpp>
#include <graze/instruction_set.hpp>
#include <stdexcept>
#include <string_view>

#include "scenes/coinciding_scenes.hpp"
#include "scenes/costly_scenes.hpp"
#include "scenes/inside_scenes.hpp"
#include "scenes/played_scene.hpp"

namespace {

using graze::ContactDetail;

constexpr int not_available = 77;
constexpr std::size_t frames = 4;

ContactDetail detail_named(std::string_view name) {
  const auto detail = graze::enumerator_named<ContactDetail>(name);
  if (!detail) throw std::runtime_error("no such detail");
  return *detail;
}

bool use(std::string_view name) {
  for (const graze::InstructionSet set : graze::available_instruction_sets()) {
    if (graze::to_string(set) != name) continue;
    graze::use_instruction_set(set);
    return true;
  }
  return false;
}

void play(std::string_view name, ContactDetail detail) {
  auto played = graze::scenes::make_played_scene(name);
  if (played == nullptr) played = graze::scenes::make_coinciding_scene(name);
  if (played == nullptr) played = graze::scenes::make_costly_scene(name);
  if (played == nullptr) played = graze::scenes::make_inside_scene(name, true);
  if (played == nullptr) throw std::runtime_error("no such scene");
  graze::SceneSettings settings = played->settings();
  settings.detail = detail;
  settings.threads = 1;
  graze::Scene scene(settings);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    played->advance(scene, frame);
    scene.step();
  }
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    if (argument_count != 4) throw std::runtime_error("wants a scene, a detail and an instruction set");
    if (!use(arguments[3])) return not_available;
    play(arguments[1], detail_named(arguments[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
