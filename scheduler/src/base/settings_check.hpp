#pragma once

#include <graze/settings.hpp>
#include <optional>
#include <string>

namespace graze {

/// Says in one sentence what is wrong with settings, or nothing if they are valid.
std::optional<std::string> problem_of(const SceneSettings& settings);
std::optional<std::string> problem_of(const ObjectSettings& settings);
std::optional<std::string> problem_of(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);

inline constexpr std::uint32_t kind_count = 256;

}  // namespace graze
