#pragma once

#include <string>
#include <string_view>

namespace graze::io {

/// The bytes as gzip writes them. Equal bytes give equal results. Throws `std::bad_alloc`.
std::string gzipped(std::string_view bytes);

/// The bytes in base64, with padding and without breaks of lines.
std::string base64_of(std::string_view bytes);

}  // namespace graze::io
