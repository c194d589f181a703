#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "import_support.hpp"

namespace graze::tests {

/// Puts together the binary half of a glTF file: each `add` is one accessor over its own part of one buffer.
class GltfBuffer {
 public:
  /// Returns the accessor's number. `type` is SCALAR, VEC3, VEC4, MAT4.
  std::size_t add(const std::string& type, const std::vector<float>& numbers);
  std::size_t add_indices(const std::vector<std::uint16_t>& indices);
  std::size_t add_joints(const std::vector<std::uint8_t>& joints);

  /// A glTF file of the buffer and of these further members of the document.
  [[nodiscard]] std::string gltf(const std::string& members) const;
  [[nodiscard]] std::string glb(const std::string& members) const;

 private:
  std::size_t add(const std::string& type, int component, std::size_t count, const std::string& part);
  [[nodiscard]] std::string document(const std::string& members, const std::string& uri) const;

  std::string bytes_;
  std::string views_;
  std::string accessors_;
  std::size_t count_ = 0;
};

}  // namespace graze::tests
