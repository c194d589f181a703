#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace graze::io {

/// The uri with every `%20` and the like replaced by its byte. A `%` without two hexadecimal digits stays.
std::string percent_decoded(std::string_view uri);

/// The bytes that base64 text stands for. Returns nothing where it is no base64.
std::optional<std::string> base64_decoded(std::string_view text);

}  // namespace graze::io
