#include "post.hpp"

#include <string>

namespace graze::cluster {

void Post::fail(const char* why) noexcept {
  try {
    transport_->fail(std::string("failed: ") + why);
  } catch (...) {
    transport_->fail({});
  }
}

}  // namespace graze::cluster
