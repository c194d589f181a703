#include "tools/gltf_file.hpp"

#include <filesystem>
#include <fstream>

namespace graze::tests {
namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ",") + part;
  return "[" + text + "]";
}

}  // namespace

int GltfFile::add_bytes(const std::string& bytes, std::size_t count, int component, const std::string& type,
                        const std::string& extra) {
  while (bytes_.size() % 4 != 0) bytes_ += '\0';
  views_.push_back(R"({"buffer":0,"byteOffset":)" + std::to_string(bytes_.size()) + R"(,"byteLength":)" +
                   std::to_string(bytes.size()) + "}");
  accessors_.push_back(R"({"bufferView":)" + std::to_string(views_.size() - 1) + R"(,"componentType":)" +
                       std::to_string(component) + R"(,"count":)" + std::to_string(count) + R"(,"type":")" +
                       type + "\"" + extra + "}");
  bytes_ += bytes;
  return static_cast<int>(accessors_.size()) - 1;
}

std::string GltfFile::write(const std::string& folder, const std::string& name,
                            const std::string& rest) const {
  const std::filesystem::path base = std::filesystem::path(folder) / name;
  std::ofstream(base.string() + ".bin", std::ios::binary) << bytes_;
  std::ofstream(base.string() + ".gltf")
      << R"({"asset":{"version":"2.0"},"buffers":[{"uri":")" << name << R"(.bin","byteLength":)"
      << bytes_.size() << R"(}],"bufferViews":)" << joined(views_) << R"(,"accessors":)" << joined(accessors_)
      << "," << rest << "}";
  return base.string() + ".gltf";
}

}  // namespace graze::tests
