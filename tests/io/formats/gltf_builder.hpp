#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/import_support.hpp"

namespace graze::tests {

/// Puts together the binary half of a glTF file: each `add` is one accessor over its own part of one buffer.
class GltfBuffer {
 public:
  /// Returns the accessor's number. `type` is SCALAR, VEC3, VEC4, MAT4.
  std::size_t add(const std::string& type, const std::vector<float>& numbers);
  std::size_t add_indices(const std::vector<std::uint16_t>& indices);
  std::size_t add_joints(const std::vector<std::uint8_t>& joints);
  /// Whole numbers of 8 or 16 bits, as they are or as fractions.
  template <typename Whole>
  std::size_t add_whole(const std::string& type, const std::vector<Whole>& numbers, bool is_normalised) {
    std::string part;
    for (const Whole number : numbers) append(part, number);
    const int component =
        sizeof(Whole) == 1 ? (Whole(-1) < Whole(0) ? 5120 : 5121) : (Whole(-1) < Whole(0) ? 5122 : 5123);
    return add(type, component, numbers.size() / width_of(type), part,
               is_normalised ? R"(,"normalized":true)" : "");
  }
  /// `count` floats of `type` that are zero but for those at `where`, which are `values`.
  std::size_t add_sparse(const std::string& type, std::size_t count, const std::vector<std::uint16_t>& where,
                         const std::vector<float>& values);

  /// A glTF file of the buffer and of these further members of the document.
  [[nodiscard]] std::string gltf(const std::string& members) const;
  /// A glTF file whose buffer is a file of its own, named by `uri`, with the bytes of `bytes()`.
  [[nodiscard]] std::string gltf(const std::string& members, const std::string& uri) const;
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::string glb(const std::string& members) const;

 private:
  static std::size_t width_of(const std::string& type);
  std::size_t add(const std::string& type, int component, std::size_t count, const std::string& part,
                  const std::string& more = "");
  std::size_t add_view(const std::string& part);
  [[nodiscard]] std::string document(const std::string& members, const std::string& uri) const;

  std::string bytes_;
  std::string views_;
  std::string accessors_;
  std::size_t view_count_ = 0;
  std::size_t count_ = 0;
};

}  // namespace graze::tests
