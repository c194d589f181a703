#pragma once

#include <filesystem>
#include <graze/io/error.hpp>
#include <new>
#include <stdexcept>
#include <string>

namespace graze::io {

inline const std::string& text_of_place(const std::string& where) {
  return where;
}
inline std::string text_of_place(const std::filesystem::path& where) {
  return where.string();
}

/// Returns what `work` returns. Where there is no memory for it, throws InputError with `where`, a text or a
/// path, and a remedy.
template <typename Place, typename Work>
auto with_memory_for(const Place& where, const Work& work) {
  constexpr const char* problem =
      ": there is not enough memory for it; split it, simplify its meshes or close other programs";
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw InputError(text_of_place(where) + problem);
  } catch (const std::length_error&) {
    throw InputError(text_of_place(where) + problem);
  }
}

}  // namespace graze::io
