// glTF is read here, from its JSON, and not by a library.
//
// assimp (5.2) mixes up nodes of one name and forgets a node's own weights. It joins cubic keys by straight
// lines, takes integer weights for floats, and ignores extensions without a word.
//
// tinygltf (2.7.0) reads the JSON and the buffers only: accessors, splines and skins are left to its caller.
// It also looks for buffers in the current folder and refuses a buffer file that is longer than announced. It
// takes a value of the wrong type for a missing one, which hides damage.

#include "gltf/gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "gltf/gltf_json.hpp"
#include "gltf/gltf_uri.hpp"
#include "mesh/unfolding.hpp"
#include "text/file_bytes.hpp"
#include "text/opened_files.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

constexpr std::size_t glb_header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;

/// The JSON of a file: all of it, or the first chunk of a binary one, whose second chunk is a buffer.
struct Chunks {
  std::string_view text;
  std::optional<std::string_view> binary;
};

Chunks find_chunks(const std::filesystem::path& path, std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return {bytes, std::nullopt};
  if (bytes.size() < glb_header_bytes + chunk_header_bytes || word_at(bytes, 8) > bytes.size())
    fail(path, joined("byte ", bytes.size(), ": the file ends before its announced length; write it again"));
  const std::size_t size = word_at(bytes, glb_header_bytes);
  const std::size_t begin = glb_header_bytes + chunk_header_bytes;
  if (word_at(bytes, glb_header_bytes + 4) != json_chunk || size > bytes.size() - begin)
    fail(path, "byte 12: the first chunk is no whole JSON chunk; write the file again");
  Chunks chunks{bytes.substr(begin, size), std::nullopt};
  const std::size_t second = begin + size;
  if (bytes.size() - second < chunk_header_bytes || word_at(bytes, second + 4) != binary_chunk) return chunks;
  const std::size_t length = word_at(bytes, second);
  if (length > bytes.size() - second - chunk_header_bytes)
    fail(path, joined("byte ", second, ": the binary chunk is cut off; write the file again"));
  chunks.binary = bytes.substr(second + chunk_header_bytes, length);
  return chunks;
}

/// Extensions that change where nothing is, only how it looks.
bool concerns_looks_only(std::string_view extension) {
  constexpr std::array<std::string_view, 8> beginnings = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                          "MSFT_texture_",  "KHR_lights_",  "EXT_lights_",
                                                          "KHR_xmp",        "KHR_technique"};
  return std::ranges::any_of(beginnings,
                             [&](std::string_view start) { return extension.starts_with(start); });
}

bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find("://");
  return colon != std::string_view::npos && colon > 0;
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& path, bool outside_files)
    : path_(path), outside_files_(outside_files) {
  const std::string bytes = read_bytes(path);
  bytes_read_ = bytes.size();
  if (bytes.starts_with("glTF") && bytes.size() >= 8 && word_at(bytes, 4) == 1)
    fail(path, "this is binary glTF 1, which is not read; convert it to glTF 2");
  const Chunks chunks = find_chunks(path, bytes);
  read_json(chunks.text);
  const json& nodes = member(root_, "nodes");
  is_version_1_ = nodes.is_object();
  if (is_version_1_) return;
  refuse_unknown_extensions();
  if (!nodes.is_array()) fail(path, "key 'nodes': there is no list of nodes; export the file again");
  if (chunks.binary) binary_chunk_ = std::string(*chunks.binary);
  buffers_.resize(list("buffers").size());
}

void GltfDocument::read_json(std::string_view text) {
  constexpr int deepest = 200;
  const auto check_depth = [&](int depth, json::parse_event_t, const json&) {
    if (depth > deepest)
      fail(path_, joined("its JSON is nested deeper than ", deepest, " levels; simplify it"));
    return true;
  };
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  try {
    root_ = json::parse(text.begin(), text.end(), check_depth);
  } catch (const json::exception& error) {
    std::string_view what = error.what();  // behind the library's own name of the error, which is in brackets
    what.remove_prefix(std::min(what.size(), what.find("] ") + 2));
    fail(path_, joined("its JSON cannot be read (", what, "); write the file again"));
  }
}

void GltfDocument::refuse_unknown_extensions() const {
  for (const json& entry : list("extensionsRequired")) {
    const std::string name = text_of(entry);
    if (name == "KHR_mesh_quantization" || name == "EXT_mesh_gpu_instancing" || concerns_looks_only(name))
      continue;
    if (name == "KHR_draco_mesh_compression")
      fail(path_,
           "it requires KHR_draco_mesh_compression (Draco), which is not read; export without compression");
    if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
      fail(path_, joined("it requires ", name, " (meshopt), which is not read; export without compression"));
    fail(path_, joined("it requires the extension '", name, "', which is not read; export without it"));
  }
}

const json& GltfDocument::list(const char* key) const {
  static const json nothing;
  const json& value = member(root_, key);
  return value.is_array() ? value : nothing;
}

void GltfDocument::fail_at(const std::string& json_path, const std::string& what) const {
  fail(path_, joined(json_path, ": ", what));
}

std::uint64_t GltfDocument::whole_number(const json& object, const char* key, const std::string& json_path,
                                         std::uint64_t largest, std::uint64_t without) const {
  const json& value = member(object, key);
  if (value.is_null()) return without;
  std::uint64_t number = largest;
  bool fits = value.is_number_unsigned();
  if (fits) number = value.get<std::uint64_t>();
  if (value.is_number_float()) {
    const double real = value.get<double>();
    fits = real >= 0 && real < 1e15 && real == std::floor(real);
    if (fits) number = static_cast<std::uint64_t>(real);
  }
  if (!fits || number > largest)
    fail_at(joined(json_path, ".", key),
            joined("expected a whole number from 0 to ", largest, "; export the file again"));
  return number;
}

std::string_view GltfDocument::view_bytes(const json& number, const std::string& json_path) {
  constexpr std::uint64_t largest = std::uint64_t{1} << 40U;
  const json& view = element(list("bufferViews"), number);
  if (!view.is_object()) fail_at(json_path, "its bufferView does not exist; export the file again");
  const std::string here = joined("bufferViews[", number.get<std::uint64_t>(), "]");
  const std::uint64_t of = whole_number(view, "buffer", here, largest, largest);
  const std::uint64_t offset = whole_number(view, "byteOffset", here, largest, 0);
  const std::uint64_t length = whole_number(view, "byteLength", here, largest, 0);
  const std::string& bytes = buffer(of, here);
  if (offset > bytes.size() || length > bytes.size() - offset)
    fail_at(here, joined("it ends at byte ", offset + length, " of a buffer of ", bytes.size(),
                         " bytes; export the file again"));
  return std::string_view(bytes).substr(offset, length);
}

std::uint64_t GltfDocument::total_bytes() {
  std::uint64_t total = 0;
  for (std::uint64_t number = 0; number < buffers_.size(); ++number)
    total += buffer(number, joined("buffers[", number, "]")).size();
  return total;
}

const std::string& GltfDocument::buffer(std::uint64_t number, const std::string& json_path) {
  if (number >= buffers_.size()) fail_at(json_path, "its buffer does not exist; export the file again");
  if (!buffers_[number]) {
    buffers_[number] = load_buffer(number, joined("buffers[", number, "]"));
    bytes_read_ += buffers_[number]->size();
  }
  return *buffers_[number];
}

std::string GltfDocument::load_buffer(std::uint64_t number, const std::string& json_path) const {
  const json& entry = list("buffers")[number];
  const json& uri = member(entry, "uri");
  const std::uint64_t announced = whole_number(entry, "byteLength", json_path, std::uint64_t{1} << 40U, 0);
  std::string bytes;
  if (uri.is_string())
    bytes = bytes_of_uri(uri.get_ref<const std::string&>(), json_path);
  else if (number == 0 && binary_chunk_)
    bytes = *binary_chunk_;
  else if (member(entry, "extensions").contains("EXT_meshopt_compression"))
    fail_at(json_path, "its data is in EXT_meshopt_compression only, which is not read; export without it");
  else
    fail_at(json_path, "it has neither a uri nor a binary chunk; export the file again");
  if (bytes.size() < announced)
    fail_at(json_path,
            joined(announced, " bytes are announced and ", bytes.size(), " are there; write the file again"));
  bytes.resize(announced);
  return bytes;
}

std::string GltfDocument::bytes_of_uri(const std::string& uri, const std::string& json_path) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    const std::string_view head = std::string_view(uri).substr(0, comma);
    if (comma == std::string::npos || !head.ends_with(";base64"))
      fail_at(json_path, "its data uri is no base64; write the file again");
    auto bytes = base64_decoded(std::string_view(uri).substr(comma + 1));
    if (!bytes) fail_at(json_path, "its base64 is damaged; write the file again");
    return std::move(*bytes);
  }
  if (has_scheme(uri)) fail_at(json_path, joined("'", uri, "' is no file beside this one; save it there"));
  std::error_code error;
  std::filesystem::path file = path_.parent_path() / percent_decoded(uri);
  if (!std::filesystem::exists(file, error)) {
    const std::filesystem::path as_written = path_.parent_path() / uri;
    if (std::filesystem::exists(as_written, error)) file = as_written;
  }
  if (!outside_files_ && !is_in_folder_of(path_, file))
    fail_at(json_path, joined("'", file.string(), "' is outside the folder of this file; ", outside_remedy));
  if (!std::filesystem::is_regular_file(file, error))
    fail_at(json_path, joined("there is no file '", file.string(), "'; put it there"));
  if (std::filesystem::file_size(file, error) == 0) return {};
  return read_bytes(file);
}

void GltfDocument::count_read(std::uint64_t numbers, const std::string& json_path) {
  count(read_, numbers, std::max(std::uint64_t{1} << 28U, 16 * bytes_read_), json_path);
}

void GltfDocument::count_kept(std::uint64_t numbers, const std::string& json_path) {
  count(kept_, numbers, most_unfolded(bytes_read_), json_path);
}

void GltfDocument::count(std::uint64_t& counter, std::uint64_t numbers, std::uint64_t most,
                         const std::string& json_path) const {
  if (counter > most || numbers > most - counter)
    fail_at(json_path, joined("the file unfolds to more than ", most, " numbers here; split it"));
  counter += numbers;
}

}  // namespace graze::io
