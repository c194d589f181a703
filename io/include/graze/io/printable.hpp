#pragma once

#include <graze/export.hpp>
#include <string>
#include <string_view>

namespace graze::io {

/// @addtogroup io_log
/// @{

/// Returns a text in one line that a terminal shows and does not obey. Use it for names that come from files
/// of others: such a name may hold the escape sequences of a terminal.
///
/// Ends of lines and tabs become blanks. Other control characters are spelled out, such as `\x1b`. So are
/// bytes that are not UTF-8, and characters that turn the direction of writing, such as `\u202e`. Everything
/// else stays as it is. Any thread may call it.
GRAZE_API std::string printable(std::string_view text);

/// @}

}  // namespace graze::io
