#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace graze::tests {

/// A named pipe that is read slowly, 4 kB at a time: whoever writes into it waits again and again.
class SlowPipe {
 public:
  explicit SlowPipe(std::filesystem::path path) : path_(std::move(path)) {
    (void)mkfifo(path_.c_str(), 0600);
    reader_ = std::thread([this] { read(); });
  }
  ~SlowPipe() { (void)bytes(); }
  SlowPipe(const SlowPipe&) = delete;
  SlowPipe& operator=(const SlowPipe&) = delete;

  /// Waits until the writer has closed the pipe, and returns all that it wrote. A pipe that nobody has opened
  /// is empty.
  const std::string& bytes() {
    if (!reader_.joinable()) return bytes_;
    const int opened =
        open(path_.c_str(), O_WRONLY | O_NONBLOCK);  // lets a reader go that waits for a writer
    if (opened >= 0) (void)close(opened);
    reader_.join();
    return bytes_;
  }

 private:
  void read() {
    const int file = open(path_.c_str(), O_RDONLY);
    if (file < 0) return;
#ifdef F_SETPIPE_SZ
    (void)fcntl(file, F_SETPIPE_SZ, 4096);
#endif
    std::array<char, 4096> part{};
    for (ssize_t count = 0; (count = ::read(file, part.data(), part.size())) > 0;) {
      bytes_.append(part.data(), static_cast<std::size_t>(count));
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    (void)close(file);
  }

  std::filesystem::path path_;
  std::string bytes_;  ///< of the reader, until it has ended
  std::thread reader_;
};

}  // namespace graze::tests
