#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gltf/gltf_document.hpp"

namespace graze::io {

/// The numbers of an accessor: `width` numbers for each of its elements. Normalised integers are their
/// fractions.
struct GltfNumbers {
  std::size_t width = 1;
  std::vector<double> values;

  [[nodiscard]] std::size_t count() const { return values.size() / width; }
  [[nodiscard]] Eigen::Vector3d vector(std::size_t index) const {
    return {values[3 * index], values[3 * index + 1], values[3 * index + 2]};
  }
};

/// The numbers of elements, ascending.
using GltfElements = std::vector<std::uint32_t>;

/// How many elements the accessor says it has, or 0 where there is none.
std::size_t accessor_count(const GltfDocument& document, const nlohmann::json& number);

/// Reads the accessor of that number, sparse ones too. `type` is the type that its use needs, such as VEC3.
/// `json_path` says where it is used. Throws InputError for another type and for numbers outside of its
/// buffers.
GltfNumbers read_accessor(GltfDocument& document, const nlohmann::json& number, const char* type,
                          const std::string& json_path);
/// Reads some of its elements.
GltfNumbers read_accessor(GltfDocument& document, const nlohmann::json& number, const char* type,
                          const std::string& json_path, const GltfElements& elements);
/// How many elements it has, all of which are in its buffers. Throws InputError as above.
std::uint64_t element_count(GltfDocument& document, const nlohmann::json& number, const char* type,
                            const std::string& json_path);

}  // namespace graze::io
