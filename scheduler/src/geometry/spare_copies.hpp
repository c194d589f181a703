#pragma once

#include <algorithm>
#include <cstddef>
#include <graze/mesh.hpp>
#include <memory>
#include <vector>

namespace graze {

/// Copies of one surface, of which reports have some. One that nobody has can be filled again.
template <typename Copy>
class SpareCopies {
 public:
  /// Chooses a copy that nobody has as the last one, or makes one. Copies of another mesh go.
  Copy& next(const std::shared_ptr<const Mesh>& mesh) {
    std::erase_if(copies_, [&](const auto& copy) { return copy->mesh != mesh; });
    const auto free =
        std::find_if(copies_.begin(), copies_.end(), [](const auto& copy) { return copy.use_count() == 1; });
    last_ = static_cast<std::size_t>(free - copies_.begin());
    if (free == copies_.end()) copies_.push_back(std::make_shared<Copy>(mesh));
    return *copies_[last_];
  }
  /// Whether there is a last one, of a mesh.
  [[nodiscard]] bool has_last_of(const std::shared_ptr<const Mesh>& mesh) const {
    return last_ < copies_.size() && copies_[last_]->mesh == mesh;
  }
  [[nodiscard]] const std::shared_ptr<Copy>& last() const { return copies_[last_]; }
  [[nodiscard]] const std::vector<std::shared_ptr<Copy>>& all() const { return copies_; }

 private:
  std::vector<std::shared_ptr<Copy>> copies_;
  std::size_t last_ = 0;
};

}  // namespace graze
