#include <fcntl.h>
#include <unistd.h>

#include <graze/io/log.hpp>

#include "io/import_support.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

/// Returns the text that `act` writes to standard error.
template <typename Act>
std::string standard_error_of(const Act& act) {
  const TemporaryFolder folder;
  const auto path = folder / "stderr";
  const int saved = dup(2);
  const int file = open(path.c_str(), O_CREAT | O_WRONLY, 0600);
  dup2(file, 2);
  act();
  dup2(saved, 2);
  close(file);
  close(saved);
  return read_file(path);
}

}  // namespace

TEST_CASE("the log writes lines of the level and above to standard error") {
  const auto say_all = [] {
    io::log_debug("one");
    io::log_info("two {} %s");
    io::log_warning("three");
    io::log_error("four");
  };
  CHECK(standard_error_of(say_all) == "graze: warning: three\ngraze: error: four\n");
  io::set_log_level(io::LogLevel::debug);
  CHECK(standard_error_of(say_all) ==
        "graze: debug: one\ngraze: info: two {} %s\ngraze: warning: three\ngraze: error: four\n");
  io::set_log_level(io::LogLevel::off);
  CHECK(standard_error_of(say_all).empty());
  io::set_log_level(io::LogLevel::warning);
}
