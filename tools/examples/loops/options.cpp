#include "examples/loops/options.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "examples/support/record_option.hpp"

namespace loops {

Options read_options(int argc, char** argv) {
  Options options;
  options.record = examples::take_option("--record", argc, argv);
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    const bool has_value = i + 1 < argc;
    if (name == "--deterministic") {
      options.deterministic = true;
    } else if (name == "--blobs") {
      options.blobs = true;
    } else if (name == "--organs" && has_value) {
      options.organs = argv[++i];
    } else if (name == "--length" && has_value) {
      options.length = std::atoi(argv[++i]);
    } else if (name == "--threads" && has_value) {
      options.threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else {
      std::fprintf(stderr,
                   "%s: unknown option, or no value: %s\n"
                   "usage: %s [--record FILE] [--length FRAMES_OR_TICKS] [--threads N]\n"
                   "       surgery_loop also has [--organs FILE.obj | --blobs] [--deterministic]\n",
                   argv[0], argv[i], argv[0]);
      std::exit(2);
    }
  }
  return options;
}

void finish(const Options& options, graze::Recorder* recorder) {
  if (recorder == nullptr) return;
  recorder->close();
  const graze::RecorderStatistics written = recorder->statistics();
  std::printf("recorded %llu frames in %s, %llu dropped\n", static_cast<unsigned long long>(written.frames),
              options.record.c_str(), static_cast<unsigned long long>(written.dropped));
}

}  // namespace loops
