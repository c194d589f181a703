#pragma once

#include <graze/graze.hpp>
#include <graze/recorder.hpp>
#include <memory>
#include <string>
#include <string_view>

namespace examples {

/// Takes an option with a value, as `--record FILE`, out of a program's arguments, and returns the value.
/// Returns an empty string if the arguments have no such option.
std::string take_option(std::string_view name, int& argc, char** argv);

/// Returns a recorder that writes a scene into a file, or null if the name is empty. The recording begins
/// with the next step, and ends with the recorder. Steps wait for it, so no frame is lost. `graze view FILE
/// -o PAGE` makes a page of it.
std::unique_ptr<graze::Recorder> make_recorder(const std::string& file, graze::Scene& scene);

/// Returns a recorder of a scene if the program was started with `--record FILE`, else null. Ends the program
/// with exit code 2 if it was started with anything else.
std::unique_ptr<graze::Recorder> recorder_by_options(int argc, char** argv, graze::Scene& scene);

}  // namespace examples
