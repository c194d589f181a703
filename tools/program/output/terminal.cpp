#include "output/terminal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <graze/io/printable.hpp>
#include <string_view>

#include "output/text.hpp"

namespace graze::tools {
namespace {

/// The lines of a text, each as io::printable() shows it.
std::string printable_lines(std::string_view text) {
  std::string lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines += io::printable(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace

void say(const char* pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  const std::string text = format_list(pattern, arguments);
  va_end(arguments);
  std::fputs(printable_lines(text).c_str(), stdout);
}

void say_aside(const char* word, const std::string& text) {
  std::fprintf(stderr, "%s: %s\n", word, io::printable(text).c_str());
}

void keep_standard_streams() {
  // Standard output is opened for reading alone, so that printing fails as it does on a full disk.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) (void)open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

bool is_standard_output_whole() {
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace graze::tools
