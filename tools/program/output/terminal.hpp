#pragma once

#include <string>

namespace graze::tools {

/// Prints to standard output, as printf does. Texts may hold names from files of others: control characters
/// in them are spelled out, as io::printable() does. Ends of lines stay, so give a name itself to
/// io::printable().
[[gnu::format(printf, 1, 2)]] void say(const char* pattern, ...);

/// Prints a line to standard error, after a word such as "note". Control characters are spelled out.
void say_aside(const char* word, const std::string& text);

/// Keeps the numbers of the three standard streams for them, also where the caller closed one. Otherwise the
/// next file that is opened gets the number, and what is printed is written into that file.
void keep_standard_streams();

/// Whether all that was printed to standard output arrived. Call it last: it writes what is still to be
/// written.
bool is_standard_output_whole();

}  // namespace graze::tools
