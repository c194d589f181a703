#include <graze/io/error.hpp>

#include "text/text_lines.hpp"

namespace graze::io {

InputError::InputError(const std::string& message) : Error(shortened(one_line(message), longest_message)) {}

}  // namespace graze::io
