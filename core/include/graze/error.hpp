#pragma once

#include <graze/export.hpp>
#include <stdexcept>
#include <string>

namespace graze {

/// @addtogroup errors
/// @{

/// Thrown for input that cannot be used. Its message is one sentence that names what was wrong and where.
///
/// Constructors, the functions that make a Mesh, Scene::add() and a second concurrent Scene::step() throw it.
/// Calls on a running scene never throw it: they leave a Diagnostic in the next report instead.
class GRAZE_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Error. Inline functions of graze call it, so that programs compile without exceptions
/// (`-fno-exceptions`). In such a program an Error ends the process.
[[noreturn]] GRAZE_API void throw_error(const std::string& message);

/// @}

}  // namespace graze
