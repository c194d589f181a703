#include "io/formats/gltf_builder.hpp"

namespace graze::tests {

std::size_t GltfBuffer::add(const std::string& type, const std::vector<float>& numbers) {
  constexpr int float_component = 5126;
  std::string part;
  for (const float number : numbers) append(part, number);
  return add(type, float_component, numbers.size() / width_of(type), part);
}

std::size_t GltfBuffer::add_indices(const std::vector<std::uint16_t>& indices) {
  constexpr int short_component = 5123;
  std::string part;
  for (const auto index : indices) append(part, index);
  return add("SCALAR", short_component, indices.size(), part);
}

std::size_t GltfBuffer::add_joints(const std::vector<std::uint8_t>& joints) {
  constexpr int byte_component = 5121;
  return add("VEC4", byte_component, joints.size() / 4, std::string(joints.begin(), joints.end()));
}

std::size_t GltfBuffer::add_sparse(const std::string& type, std::size_t count,
                                   const std::vector<std::uint16_t>& where,
                                   const std::vector<float>& values) {
  std::string indices;
  for (const auto index : where) append(indices, index);
  std::string numbers;
  for (const float value : values) append(numbers, value);
  const std::size_t index_view = add_view(indices);
  const std::size_t value_view = add_view(numbers);
  accessors_ += (count_ == 0 ? "" : ",") + std::string(R"({"componentType":5126,"count":)") +
                std::to_string(count) + R"(,"type":")" + type + R"(","sparse":{"count":)" +
                std::to_string(where.size()) + R"(,"indices":{"bufferView":)" + std::to_string(index_view) +
                R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(value_view) + "}}}";
  return count_++;
}

std::size_t GltfBuffer::width_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  return type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

std::size_t GltfBuffer::add(const std::string& type, int component, std::size_t count,
                            const std::string& part, const std::string& more) {
  const std::size_t view = add_view(part);
  accessors_ += (count_ == 0 ? "" : ",") + std::string(R"({"bufferView":)") + std::to_string(view) +
                R"(,"componentType":)" + std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                R"(,"type":")" + type + "\"" + more + "}";
  return count_++;
}

std::size_t GltfBuffer::add_view(const std::string& part) {
  views_ += (view_count_ == 0 ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
            std::to_string(bytes_.size()) + R"(,"byteLength":)" + std::to_string(part.size()) + "}";
  bytes_ += part;
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  return view_count_++;
}

std::string GltfBuffer::document(const std::string& members, const std::string& uri) const {
  return R"({"asset":{"version":"2.0"},)" + members + R"(,"accessors":[)" + accessors_ +
         R"(],"bufferViews":[)" + views_ + R"(],"buffers":[{)" + uri + R"("byteLength":)" +
         std::to_string(bytes_.size()) + "}]}";
}

std::string GltfBuffer::gltf(const std::string& members) const {
  return document(members, R"("uri":"data:application/octet-stream;base64,)" + base64(bytes_) + R"(",)");
}

std::string GltfBuffer::gltf(const std::string& members, const std::string& uri) const {
  return document(members, R"("uri":")" + uri + R"(",)");
}

std::string GltfBuffer::glb(const std::string& members) const {
  std::string text = document(members, "");
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string file = "glTF";
  append<std::uint32_t>(file, 2);
  append(file, static_cast<std::uint32_t>(28 + text.size() + bytes_.size()));
  append(file, static_cast<std::uint32_t>(text.size()));
  file += "JSON" + text;
  append(file, static_cast<std::uint32_t>(bytes_.size()));
  file += "BIN";
  file += '\0';
  return file + bytes_;
}

}  // namespace graze::tests
