#include <graze/version.hpp>

namespace graze {

std::array<int, 3> library_version() noexcept {
  return header_version;
}

}  // namespace graze
