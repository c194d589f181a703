#include "export/gltf_data.hpp"

namespace graze::io {
namespace {

// Numbers that glTF takes from OpenGL.
constexpr int vertex_buffer = 34962;
constexpr int index_buffer = 34963;
constexpr int unsigned_int_numbers = 5125;
constexpr int float_numbers = 5126;

nlohmann::json three_numbers(const Eigen::Vector3f& point) {
  return {point.x(), point.y(), point.z()};
}

}  // namespace

std::size_t GltfData::add(const void* numbers, std::size_t byte_count, int target, nlohmann::json accessor) {
  accessor["bufferView"] = views_.size();
  accessors_.push_back(std::move(accessor));
  views_.push_back(
      {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", byte_count}, {"target", target}});
  bytes_.append(static_cast<const char*>(numbers), byte_count);
  return accessors_.size() - 1;
}

std::size_t GltfData::add_positions(const std::vector<Eigen::Vector3f>& positions) {
  Eigen::Vector3f low = positions.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& position : positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  return add(positions.data(), positions.size() * sizeof(Eigen::Vector3f), vertex_buffer,
             {{"componentType", float_numbers},
              {"count", positions.size()},
              {"type", "VEC3"},
              {"min", three_numbers(low)},
              {"max", three_numbers(high)}});
}

std::size_t GltfData::add_normals(const std::vector<Eigen::Vector3f>& normals) {
  return add(normals.data(), normals.size() * sizeof(Eigen::Vector3f), vertex_buffer,
             {{"componentType", float_numbers}, {"count", normals.size()}, {"type", "VEC3"}});
}

std::size_t GltfData::add_scalars(const std::vector<float>& numbers) {
  return add(numbers.data(), numbers.size() * sizeof(float), vertex_buffer,
             {{"componentType", float_numbers}, {"count", numbers.size()}, {"type", "SCALAR"}});
}

std::size_t GltfData::add_indices(const std::vector<std::uint32_t>& indices) {
  return add(indices.data(), indices.size() * sizeof(std::uint32_t), index_buffer,
             {{"componentType", unsigned_int_numbers}, {"count", indices.size()}, {"type", "SCALAR"}});
}

}  // namespace graze::io
