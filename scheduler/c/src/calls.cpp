#include "calls.hpp"

#include <algorithm>
#include <array>
#include <graze/instruction_set.hpp>
#include <graze/settings.hpp>
#include <graze/version.hpp>
#include <string>

namespace graze::c {
namespace {

/// A message that is longer is cut, so that to keep it takes no memory.
constexpr std::size_t most_bytes = 1024;
thread_local std::array<char, most_bytes> last_error{};

/// Returns the length of the text before byte `end`, without a character that would be cut in two.
std::size_t whole_characters(std::string_view text, std::size_t end) {
  if (end >= text.size()) return text.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return end;
}

}  // namespace

void set_last_error(std::string_view message) noexcept {
  const std::size_t length = whole_characters(message, most_bytes - 1);
  std::copy_n(message.data(), length, last_error.data());
  last_error[length] = '\0';
}

}  // namespace graze::c

using graze::c::guarded;

extern "C" {

const char* graze_last_error() {
  return graze::c::last_error.data();
}

void graze_library_version(int32_t version[3]) {
  if (version != nullptr) std::ranges::copy(graze::library_version(), version);
}

uint32_t graze_max_threads() {
  return graze::max_threads();
}

const char* graze_instruction_set() {
  return graze::to_string(graze::instruction_set()).data();
}

graze_status graze_use_instruction_set(const char* name) {
  return guarded([&] {
    const std::string_view wanted = &graze::c::given(name, "name");
    const auto sets = graze::available_instruction_sets();
    const auto found =
        std::ranges::find_if(sets, [&](graze::InstructionSet set) { return to_string(set) == wanted; });
    if (found == sets.end())
      throw graze::c::BadArgument("no instruction set \"" + std::string(wanted) + "\" is available here");
    graze::use_instruction_set(*found);
  });
}

}  // extern "C"
