#include <graze/io/error.hpp>
#include <graze/io/printable.hpp>

namespace graze::io {

InputError::InputError(const std::string& message) : Error(printable(message)) {}

}  // namespace graze::io
