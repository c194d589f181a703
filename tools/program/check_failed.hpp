#pragma once

#include <span>
#include <stdexcept>
#include <string>

namespace graze::tools {

/// Thrown when a check that a command was asked to do fails. The command prints this one line on standard
/// error and exits with code 1.
class CheckFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws where there is a violation: the first, and how many there are.
inline void throw_violations(std::span<const std::string> violations) {
  if (!violations.empty())
    throw CheckFailed(violations.front() + " (" + std::to_string(violations.size()) + " violations in all)");
}

}  // namespace graze::tools
