#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>

#include "text/file_bytes.hpp"
#include "text/number_text.hpp"

namespace graze::io {

/// A vertex of a text: the next three words of `rest`, which are cut off it. Throws InputError with the
/// line's number where one of them is no number.
inline Eigen::Vector3d read_vertex(std::string_view& rest, const std::filesystem::path& path,
                                   std::size_t line) {
  Eigen::Vector3d vertex;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string_view word = next_word(rest);
    const auto number = parse_number<double>(word);
    if (!number)
      fail(path, line,
           joined("a vertex needs three numbers and has '", word, "' as number ", axis + 1,
                  "; correct the line"));
    vertex[axis] = *number;
  }
  return vertex;
}

}  // namespace graze::io
