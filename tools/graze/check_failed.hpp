#pragma once

#include <stdexcept>

namespace graze::tools {

/// What a command was asked to check does not hold: exit code 1, and this one line on standard error.
class CheckFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace graze::tools
