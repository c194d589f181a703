#include "gnuplot.hpp"

#include <cstdio>
#include <cstdlib>
#include <graze/io/error.hpp>

namespace graze::tools {

bool has_gnuplot() {
  return std::system("gnuplot --version >/dev/null 2>&1") == 0;
}

void run_gnuplot(const std::string& script, const std::string& what) {
  std::FILE* gnuplot = popen("gnuplot", "w");
  const bool written =
      gnuplot != nullptr && std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  const bool drawn = gnuplot != nullptr && pclose(gnuplot) == 0;
  if (!written || !drawn)
    throw io::InputError(what + ": gnuplot could not draw this figure; see its message above");
}

std::string gnuplot_quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) result += letter == '\'' ? std::string("''") : std::string(1, letter);
  return result + "'";
}

}  // namespace graze::tools
