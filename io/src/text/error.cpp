#include <graze/io/error.hpp>

#include "text/text_lines.hpp"

namespace graze::io {

InputError::InputError(const std::string& message) : Error(one_line(message)) {}

}  // namespace graze::io
