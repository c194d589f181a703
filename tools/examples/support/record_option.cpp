#include "examples/support/record_option.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace examples {

std::string take_option(std::string_view name, int& argc, char** argv) {
  char** const found = std::find(argv + 1, argv + argc, name);
  if (found + 1 >= argv + argc) return {};
  std::string value = found[1];
  std::copy(found + 2, argv + argc, found);
  argc -= 2;
  return value;
}

std::unique_ptr<graze::Recorder> make_recorder(const std::string& file, graze::Scene& scene) {
  if (file.empty()) return nullptr;
  return std::make_unique<graze::Recorder>(scene, file,
                                           graze::RecorderSettings{.when_behind = graze::WhenBehind::wait});
}

std::unique_ptr<graze::Recorder> recorder_by_options(int argc, char** argv, graze::Scene& scene) {
  const std::string file = take_option("--record", argc, argv);
  if (argc == 1) return make_recorder(file, scene);
  std::fprintf(stderr, "usage: %s [--record FILE]\n", argv[0]);
  std::exit(2);
}

}  // namespace examples
