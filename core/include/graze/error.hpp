#pragma once

#include <graze/export.hpp>
#include <stdexcept>

namespace graze {

/// Thrown by constructors, `Scene::add` and a second concurrent `Scene::step`: one sentence that names what
/// was wrong and where. Calls on a running scene never throw it; they leave a Diagnostic instead.
class GRAZE_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace graze
