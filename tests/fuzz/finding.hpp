#pragma once

#include <cstdio>
#include <cstdlib>
#include <graze/io/error.hpp>
#include <string>
#include <string_view>

namespace graze::fuzz {

/// Says what does not hold and ends the process. libFuzzer keeps the input.
[[noreturn]] inline void finding(const std::string& what) {
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

inline void expect(bool holds, std::string_view what) {
  if (!holds) finding(std::string(what));
}

/// Whether `read` took its input. What it may do instead is to throw an InputError of one line. Anything else
/// is a finding.
template <typename Read>
bool accepts(Read read) {
  try {
    read();
    return true;
  } catch (const io::InputError& error) {
    const std::string_view message = error.what();
    expect(!message.empty(), "a refusal without a word");
    if (message.find_first_of("\r\n") != std::string_view::npos)
      finding("a refusal of several lines: " + std::string(message));
    return false;
  } catch (const std::exception& error) {
    finding(std::string("another exception than InputError: ") + error.what());
  }
}

}  // namespace graze::fuzz
