#pragma once

#include <string>
#include <string_view>

namespace graze::io {

/// The base64 text of bytes, with `=` at its end where they are no multiple of three.
std::string base64_encoded(std::string_view bytes);

}  // namespace graze::io
