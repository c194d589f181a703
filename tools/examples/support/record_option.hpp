#pragma once

#include <graze/graze.hpp>
#include <graze/recorder.hpp>
#include <memory>

namespace examples {

/// Returns a recorder of a scene if the program was started with `--record FILE`, else null. The recording
/// begins with the next step and ends with the recorder. `graze view FILE` shows it. Ends the program with
/// exit code 2 if it was started with anything else.
std::unique_ptr<graze::Recorder> recorder_by_options(int argc, char** argv, graze::Scene& scene);

}  // namespace examples
