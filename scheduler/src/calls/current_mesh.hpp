#pragma once

#include <cstdint>
#include <graze/mesh.hpp>
#include <memory>
#include <mutex>
#include <utility>

namespace graze {

/// A mesh of an object, and how often the object's mesh had been replaced before it came.
struct NamedMesh {
  std::shared_ptr<const Mesh> mesh;
  std::uint64_t number = 0;
};

/// The mesh that an object has by the calls made so far. Any thread may ask for it while another replaces it.
/// The lock is held for as long as it takes to copy a pointer.
class CurrentMesh {
 public:
  [[nodiscard]] NamedMesh get() const {
    const std::lock_guard lock(mutex_);
    return current_;
  }
  /// Makes a mesh the object's first one.
  void begin(std::shared_ptr<const Mesh> mesh) {
    const std::lock_guard lock(mutex_);
    current_ = {std::move(mesh), 0};
  }
  void replace(std::shared_ptr<const Mesh> mesh) {
    const std::lock_guard lock(mutex_);
    current_.mesh.swap(mesh);
    ++current_.number;
  }

 private:
  mutable std::mutex mutex_;
  NamedMesh current_;
};

}  // namespace graze
