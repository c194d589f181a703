#pragma once

#include <graze/error.hpp>
#include <string>

namespace graze::tests {

/// The message of the Error that a call throws. Empty if it throws none.
template <typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace graze::tests
