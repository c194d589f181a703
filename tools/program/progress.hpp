#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace graze::tools {

/// One line on a terminal that says how far a long run is; nothing when piped.
class Progress {
 public:
  /// Says "`what` 1 of `count`" and so on.
  Progress(std::string what, std::uint64_t count);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `index` counts from 0.
  void at(std::uint64_t index);

 private:
  std::string what_;
  std::uint64_t count_;
  bool shown_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace graze::tools
