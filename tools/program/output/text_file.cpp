#include "output/text_file.hpp"

#include <fstream>
#include <graze/io/error.hpp>
#include <sstream>

namespace graze::tools {

std::string read_text_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) throw io::InputError(path.string() + ": cannot be read");
  return text.str();
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw io::InputError(path.string() + ": could not be written to its end");
}

}  // namespace graze::tools
