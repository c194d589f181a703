#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace graze::tests {

/// Builds a small glTF with its binary beside it. Numbers go in as a list. Every list is one accessor.
class GltfFile {
 public:
  /// `component` is 5126 for float, 5123 for uint16, 5121 for uint8. `type` is SCALAR, VEC3, VEC4, MAT4.
  template <typename Number>
  int add(const std::vector<Number>& numbers, int component, const std::string& type,
          const std::string& extra = "");

  /// Writes `name`.gltf and `name`.bin into `folder`. `rest` is the document but for buffers, views and
  /// accessors.
  std::string write(const std::string& folder, const std::string& name, const std::string& rest) const;

 private:
  int add_bytes(const std::string& bytes, std::size_t count, int component, const std::string& type,
                const std::string& extra);

  std::string bytes_;
  std::vector<std::string> views_;
  std::vector<std::string> accessors_;
};

template <typename Number>
int GltfFile::add(const std::vector<Number>& numbers, int component, const std::string& type,
                  const std::string& extra) {
  const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
  const auto* first = reinterpret_cast<const char*>(numbers.data());
  return add_bytes(std::string(first, numbers.size() * sizeof(Number)), numbers.size() / width, component,
                   type, extra);
}

}  // namespace graze::tests
