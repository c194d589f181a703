#include <graze/error.hpp>

namespace graze {

void throw_error(const std::string& message) {
  throw Error(message);
}

}  // namespace graze
