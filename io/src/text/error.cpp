#include <graze/io/error.hpp>
#include <graze/io/printable.hpp>

#include "text/text_lines.hpp"

namespace graze::io {

InputError::InputError(const std::string& message) : Error(shortened(printable(message), longest_message)) {}

}  // namespace graze::io
