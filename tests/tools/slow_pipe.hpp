#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace graze::tests {

/// A named pipe that is read slowly, 4 kB at a time: whoever writes into it waits again and again. It may be
/// opened and closed more than once.
class SlowPipe {
 public:
  explicit SlowPipe(const std::filesystem::path& path) {
    (void)mkfifo(path.c_str(), 0600);
    file_ = open(path.c_str(), O_RDWR | O_NONBLOCK);
#ifdef F_SETPIPE_SZ
    (void)fcntl(file_, F_SETPIPE_SZ, 4096);
#endif
    reader_ = std::thread([this] { read(); });
  }
  ~SlowPipe() {
    (void)bytes();
    (void)close(file_);
  }
  SlowPipe(const SlowPipe&) = delete;
  SlowPipe& operator=(const SlowPipe&) = delete;

  /// All that was written, once nobody writes any more.
  const std::string& bytes() {
    is_written_ = true;
    if (reader_.joinable()) reader_.join();
    return bytes_;
  }

 private:
  void read() {
    std::array<char, 4096> part{};
    while (true) {
      const bool is_written = is_written_;
      const ssize_t count = ::read(file_, part.data(), part.size());
      if (count > 0)
        bytes_.append(part.data(), static_cast<std::size_t>(count));
      else if (is_written)
        return;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }

  int file_ = -1;
  std::atomic<bool> is_written_{false};
  std::string bytes_;  ///< of the reader, until it has ended
  std::thread reader_;
};

}  // namespace graze::tests
