#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graze::io {

/// The JSON of a glTF file and the bytes of its buffers. A buffer is loaded when it is first asked for. Every
/// member throws InputError that names the file and the path in its JSON.
class GltfDocument {
 public:
  /// Reads a .gltf or .glb file. Throws InputError when it is cut off, no JSON or binary glTF 1, and when it
  /// requires an extension that is not read. `outside_files` is that of ReadOptions.
  explicit GltfDocument(const std::filesystem::path& path, bool outside_files = false);

  /// Whether the file is a text of version 1, whose JSON has another shape. Nothing else may be asked for
  /// then.
  [[nodiscard]] bool is_version_1() const { return is_version_1_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const nlohmann::json& root() const { return root_; }
  /// A list of the document, such as `meshes`. It is null where it is missing.
  [[nodiscard]] const nlohmann::json& list(const char* key) const;

  [[noreturn]] void fail_at(const std::string& json_path, const std::string& what) const;

  /// The whole number under `key`, at most `largest`, or `without` where the key is missing.
  [[nodiscard]] std::uint64_t whole_number(const nlohmann::json& object, const char* key,
                                           const std::string& json_path, std::uint64_t largest,
                                           std::uint64_t without) const;

  /// The bytes of `bufferViews[number]`.
  std::string_view view_bytes(const nlohmann::json& number, const std::string& json_path);
  /// The bytes of all buffers together.
  std::uint64_t total_bytes();

  /// Counts numbers that are read, and those that are kept in memory, since one accessor may be used any
  /// number of times. Throws when there are more than a file of its size may have.
  void count_read(std::uint64_t numbers, const std::string& json_path);
  void count_kept(std::uint64_t numbers, const std::string& json_path);

 private:
  void count(std::uint64_t& counter, std::uint64_t numbers, std::uint64_t most,
             const std::string& json_path) const;
  void read_json(std::string_view text);
  void refuse_unknown_extensions() const;
  const std::string& buffer(std::uint64_t number, const std::string& json_path);
  [[nodiscard]] std::string load_buffer(std::uint64_t number, const std::string& json_path) const;
  [[nodiscard]] std::string bytes_of_uri(const std::string& uri, const std::string& json_path) const;

  std::filesystem::path path_;
  bool outside_files_;
  nlohmann::json root_;
  bool is_version_1_ = false;
  std::optional<std::string> binary_chunk_;
  std::vector<std::optional<std::string>> buffers_;
  std::uint64_t bytes_read_ = 0;  ///< of the file and its buffers
  std::uint64_t read_ = 0;
  std::uint64_t kept_ = 0;
};

}  // namespace graze::io
