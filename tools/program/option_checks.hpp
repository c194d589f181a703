#pragma once

#include <CLI/Validators.hpp>
#include <cstdint>
#include <limits>
#include <string>

namespace graze::tools {

/// Checks that an option's text is a whole number from `least` to `most`. A refusal says the range, and
/// `reason` after it where there is one.
CLI::Validator whole_number(std::uint64_t least,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max(),
                            const std::string& reason = "");

/// The ranges of a number that is not whole.
enum class NumberRange : std::uint8_t { above_0, at_least_0, at_least_0_or_infinite };

/// Checks that an option's text is a number of a range. It is finite, unless the range says otherwise.
CLI::Validator real_number(NumberRange range);

/// Checks that a number of threads is from 1 to `max_threads()`.
CLI::Validator thread_number();

/// Checks that the name of a file is not empty.
CLI::Validator file_name();

}  // namespace graze::tools
