#include "io/import_support.hpp"

#include <cstdio>
#include <graze/io/error.hpp>

#include "sanitizers.hpp"
#ifdef GRAZE_HAS_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>
#endif

namespace graze::tests {

std::filesystem::path shared_file(const std::string& name) {
  return std::filesystem::path(GRAZE_SHARED_DATA) / name;
}

std::filesystem::path assimp_model(const std::string& name) {
  return std::filesystem::path(GRAZE_ASSIMP_MODELS) / name;
}

bool is_missing(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) return false;
  std::printf("skipped: %s is not there\n", file.c_str());
  return true;
}

std::vector<Corners> faces_of(const Mesh& mesh) {
  std::vector<Corners> faces;
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i)
    faces.emplace_back(mesh.face(i).begin(), mesh.face(i).end());
  return faces;
}

std::string refusal_of(const std::filesystem::path& file) {
  try {
    io::MeshFile::read(file);
  } catch (const io::InputError& error) {
    const std::string message = error.what();
    INFO(message);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.starts_with(file.string() + ": "));
    CHECK(message.find("; ") != std::string::npos);  // the remedy
    return message.substr(std::min(message.size(), file.string().size() + 2));
  }
  return "";
}

double largest_difference(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j)
      word = (word << 8U) | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? digits[(word >> (18U - 6U * static_cast<unsigned>(j))) & 63U] : '=';
  }
  return text;
}

Box make_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Box box;
  for (unsigned i = 0; i < 8; ++i)
    box.positions.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                               (i & 4U) != 0 ? high.z() : low.z());
  box.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return box;
}

#ifdef GRAZE_HAS_ADDRESS_SANITIZER
AssimpLeaks::AssimpLeaks() {
  __lsan_disable();
}
AssimpLeaks::~AssimpLeaks() {
  __lsan_enable();
}
#else
AssimpLeaks::AssimpLeaks() = default;
AssimpLeaks::~AssimpLeaks() = default;
#endif

}  // namespace graze::tests
