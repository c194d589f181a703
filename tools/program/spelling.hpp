#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace graze::tools {

/// How many letters have to be added, left out, replaced, or exchanged with their neighbour to make one word
/// of another.
std::size_t spelling_distance(std::string_view a, std::string_view b);

/// The word that was most likely meant: one that begins with `word`, or else the nearest one. At most a third
/// of its letters may be wrong. Nothing where no word is near. Of equally near ones the first.
std::optional<std::string> nearest_word(const std::string& word, std::span<const std::string> words);

}  // namespace graze::tools
