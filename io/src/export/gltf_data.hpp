#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace graze::io {

/// The binary data of a glTF file that is being written, with the buffer views and accessors that name its
/// parts. All numbers have 4 bytes, so each part begins where the format wants it.
class GltfData {
 public:
  /// Add a list that is not empty, and return the index of its accessor.
  std::size_t add_positions(const std::vector<Eigen::Vector3f>& positions);
  std::size_t add_normals(const std::vector<Eigen::Vector3f>& normals);
  std::size_t add_scalars(const std::vector<float>& numbers);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] const nlohmann::json& views() const { return views_; }
  [[nodiscard]] const nlohmann::json& accessors() const { return accessors_; }

 private:
  std::size_t add(const void* numbers, std::size_t byte_count, int target, nlohmann::json accessor);

  std::string bytes_;
  nlohmann::json views_ = nlohmann::json::array();
  nlohmann::json accessors_ = nlohmann::json::array();
};

}  // namespace graze::io
