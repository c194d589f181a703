#pragma once

#include <graze/error.hpp>
#include <string>

namespace graze::io {

/// @addtogroup errors
/// @{

/// Thrown for a file that cannot be used. Its message is one line that names the file, where in it the
/// problem is, and what to do.
///
/// An example is "liver.obj: line 12: a face names vertex 99 of 8; remove the face or add the vertex".
class GRAZE_API InputError : public graze::Error {
 public:
  /// Makes an error with a message. printable() is applied to `message`: names in a file may bring in ends of
  /// lines and control characters.
  explicit InputError(const std::string& message);
};

/// @}

}  // namespace graze::io
