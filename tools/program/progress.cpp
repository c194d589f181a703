#include "progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "output/text.hpp"

namespace graze::tools {

Progress::Progress(std::string what, std::uint64_t count)
    : what_(std::move(what)), count_(count), shown_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::at(std::uint64_t index) {
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  std::fprintf(stderr, "\r\033[K%s %llu of %llu", what_.c_str(), number(index + 1), number(count_));
  std::fflush(stderr);
}

}  // namespace graze::tools
