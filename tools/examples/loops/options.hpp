#pragma once

#include <graze/recorder.hpp>
#include <string>

namespace loops {

/// The options that a loop is started with.
struct Options {
  std::string record;          ///< the file of a recording, or empty, see `graze view`
  std::string organs;          ///< an OBJ file with the organs. Empty means the loop's own choice
  bool blobs = false;          ///< organs are generated, not read
  int length = 0;              ///< frames or ticks. 0 means the loop's own number
  unsigned threads = 0;        ///< of graze's steps. 0 means one for each processor
  bool deterministic = false;  ///< ticks are counted, not timed
};

/// Reads the options of a program's command line. Ends the program with exit code 2 if one is unknown.
Options read_options(int argc, char** argv);

/// Finishes a recording, and prints what it holds. Does nothing without one.
void finish(const Options& options, graze::Recorder* recorder);

}  // namespace loops
