#pragma once

#include <graze/error.hpp>
#include <string>

namespace graze::io {

/// Thrown for input that cannot be used: one line that names the file, the place in it and what to do, such
/// as "liver.obj: line 12: a face names vertex 99 of 8; remove the face or add the vertex".
class GRAZE_API InputError : public graze::Error {
 public:
  /// Ends of lines in `message`, which names of the file may bring in, become blanks.
  explicit InputError(const std::string& message);
};

}  // namespace graze::io
