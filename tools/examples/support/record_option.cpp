#include "examples/support/record_option.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace examples {

std::unique_ptr<graze::Recorder> recorder_by_options(int argc, char** argv, graze::Scene& scene) {
  if (argc == 1) return nullptr;
  if (argc == 3 && std::string_view(argv[1]) == "--record")
    return std::make_unique<graze::Recorder>(scene, argv[2]);
  std::fprintf(stderr, "usage: %s [--record FILE]\n", argv[0]);
  std::exit(2);
}

}  // namespace examples
