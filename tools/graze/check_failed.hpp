#pragma once

#include <stdexcept>

namespace graze::tools {

/// Thrown when a check that a command was asked to do fails. The command prints this one line on standard
/// error and exits with code 1.
class CheckFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace graze::tools
