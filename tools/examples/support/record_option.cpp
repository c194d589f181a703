#include "examples/support/record_option.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace examples {

std::string take_record_option(int& argc, char** argv) {
  char** const found =
      std::find_if(argv + 1, argv + argc, [](std::string_view word) { return word == "--record"; });
  if (found + 1 >= argv + argc) return {};
  std::string file = found[1];
  std::copy(found + 2, argv + argc, found);
  argc -= 2;
  return file;
}

std::unique_ptr<graze::Recorder> make_recorder(const std::string& file, graze::Scene& scene) {
  if (file.empty()) return nullptr;
  return std::make_unique<graze::Recorder>(scene, file);
}

std::unique_ptr<graze::Recorder> recorder_by_options(int argc, char** argv, graze::Scene& scene) {
  const std::string file = take_record_option(argc, argv);
  if (argc == 1) return make_recorder(file, scene);
  std::fprintf(stderr, "usage: %s [--record FILE]\n", argv[0]);
  std::exit(2);
}

}  // namespace examples
