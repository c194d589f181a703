#pragma once

#include <graze/settings.hpp>
#include <optional>
#include <string>

namespace graze {

/// What is wrong with settings, as one sentence; nothing where all is well.
std::optional<std::string> problem_of(const SceneSettings& settings);
std::optional<std::string> problem_of(const ObjectSettings& settings);
std::optional<std::string> problem_of(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);

inline constexpr std::uint32_t kind_count = 256;

}  // namespace graze
