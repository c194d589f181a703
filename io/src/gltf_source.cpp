#include "gltf_source.hpp"

#include <array>
#include <string_view>

#include "file_bytes.hpp"
#include "gltf_check.hpp"
#include "gltf_json.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

std::uint32_t little_endian_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i > 0; --i)
    number = (number << 8U) | static_cast<unsigned char>(bytes[offset + i - 1]);
  return number;
}

void put_little_endian(std::string& bytes, std::uint64_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((number >> shift) & 0xFFU);
}

/// Where the JSON of a file is: all of it, or the first chunk of a binary one.
struct JsonRange {
  std::size_t begin = 0;
  std::size_t size = 0;
  bool is_chunk = false;
};

constexpr std::size_t glb_header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A;

JsonRange find_json(const std::filesystem::path& path, std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return {0, bytes.size(), false};
  if (bytes.size() < glb_header_bytes + chunk_header_bytes || little_endian_at(bytes, 8) > bytes.size())
    fail(path, joined("byte ", bytes.size(), ": the file ends before its announced length; write it again"));
  const std::size_t size = little_endian_at(bytes, glb_header_bytes);
  const std::size_t begin = glb_header_bytes + chunk_header_bytes;
  if (little_endian_at(bytes, glb_header_bytes + 4) != json_chunk || size > bytes.size() - begin)
    fail(path, "byte 12: the first chunk is no whole JSON chunk; write the file again");
  return {begin, size, true};
}

json parse(const std::filesystem::path& path, std::string_view text) {
  constexpr int deepest = 200;
  const auto check_depth = [&](int depth, json::parse_event_t, const json&) {
    if (depth > deepest)
      fail(path, joined("its JSON is nested deeper than ", deepest, " levels; simplify it"));
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), check_depth);
  } catch (const json::exception& error) {
    fail(path, joined("its JSON cannot be read (", error.what(), "); write the file again"));
  }
}

/// Names every node: its own name, its mesh's or "node <number>", with "#2" and so on where that is taken.
void name_nodes(json& document) {
  std::set<std::string> taken;
  std::size_t number = 0;
  for (auto& node : document["nodes"]) {
    const std::size_t index = number++;
    if (!node.is_object()) continue;
    std::string name = text_of(member(node, "name"));
    if (name.empty())
      name = text_of(member(element(member(document, "meshes"), member(node, "mesh")), "name"));
    if (name.empty()) name = joined("node ", index);
    std::string unique = name;
    for (std::size_t copy = 2; !taken.insert(unique).second; ++copy) unique = joined(name, "#", copy);
    node["name"] = unique;
  }
}

/// A node's own morph weights come before its mesh's; assimp reads the mesh's only.
void move_weights(json& document) {
  for (const auto& node : document["nodes"]) {
    const json& weights = member(node, "weights");
    const json& mesh = member(node, "mesh");
    if (weights.is_array() && element(member(document, "meshes"), mesh).is_object())
      document["meshes"][mesh.get<std::size_t>()]["weights"] = weights;
  }
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) {
      return std::uint32_t{static_cast<unsigned char>(bytes[i + at])};
    };
    const std::uint32_t word = (byte(0) << 16U) | (byte(1) << 8U) | byte(2);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) text += digits[(word >> shift) & 63U];
  }
  return text;
}

/// Skins without inverse bind matrices mean the identity; assimp needs to be told.
void add_bind_matrices(json& document) {
  if (!member(document, "skins").is_array() || !member(document, "buffers").is_array() ||
      !member(document, "bufferViews").is_array() || !member(document, "accessors").is_array())
    return;
  constexpr std::uint32_t one = 0x3F800000;
  for (auto& skin : document["skins"]) {
    const std::size_t count = member(skin, "joints").size();
    if (!skin.is_object() || skin.contains("inverseBindMatrices") || count == 0) continue;
    std::string bytes;
    const std::size_t whole = (count + 2) / 3 * 3;  // so that the bytes are whole groups of three for base64
    for (std::size_t number = 0; number < whole * 16; ++number)
      put_little_endian(bytes, number % 16 % 5 == 0 ? one : 0);
    document["buffers"].push_back(
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    document["bufferViews"].push_back(
        {{"buffer", document["buffers"].size() - 1}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"count", count},
                                     {"type", "MAT4"}});
    skin["inverseBindMatrices"] = document["accessors"].size() - 1;
  }
}

void note_interpolation(const std::filesystem::path& path, const json& document, GltfSource& source) {
  std::size_t number = 0;
  bool has_curves = false;
  for (const auto& animation : member(document, "animations")) {
    for (const auto& channel : member(animation, "channels")) {
      const json& sampler = element(member(animation, "samplers"), member(channel, "sampler"));
      const std::string interpolation = text_of(member(sampler, "interpolation"));
      const json& target = member(channel, "target");
      const json& node = element(member(document, "nodes"), member(target, "node"));
      if (interpolation == "STEP")
        source.steps.insert({number, text_of(member(node, "name")), text_of(member(target, "path"))});
      has_curves = has_curves || interpolation == "CUBICSPLINE";
    }
    ++number;
  }
  if (has_curves)
    source.warnings.push_back(joined(path.string(), ": cubic spline keys are joined by straight lines"));
}

std::optional<std::uint64_t> face_count(const json& document, const json& primitive) {
  const json& mode = member(primitive, "mode");
  const std::uint64_t kind = mode.is_null() ? 4 : number_of(mode);
  const json& indices = member(primitive, "indices");
  const json& position = member(member(primitive, "attributes"), "POSITION");
  const json& accessor = element(member(document, "accessors"), indices.is_null() ? position : indices);
  const json& count = member(accessor, "count");
  if (kind < 4 || kind > 6 || !count.is_number_unsigned()) return std::nullopt;
  const auto corners = count.get<std::uint64_t>();
  if (kind == 4) return corners / 3;
  return corners > 2 ? corners - 2 : 0;
}

/// Names meshes by their numbers, and notes how many faces each of their primitives has. assimp appends the
/// number of the primitive where there are several, and keeps no order.
void name_meshes(json& document, GltfSource& source) {
  if (!member(document, "meshes").is_array()) return;
  std::size_t number = 0;
  for (auto& mesh : document["meshes"]) {
    const std::string name = joined("mesh", number);
    const json& primitives = member(mesh, "primitives");
    for (std::size_t i = 0; primitives.is_array() && i < primitives.size(); ++i)
      if (const auto count = face_count(document, primitives[i]))
        source.primitives[primitives.size() > 1 ? joined(name, "-", i) : name] = {
            joined("meshes[", number, "] ('", text_of(member(mesh, "name")), "').primitives[", i, "]"),
            *count};
    if (mesh.is_object()) mesh["name"] = name;
    ++number;
  }
}

std::string with_json(std::string_view bytes, const JsonRange& place, const json& document) {
  std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  if (!place.is_chunk) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string_view tail = bytes.substr(place.begin + place.size);
  std::string result(bytes.substr(0, 8));
  put_little_endian(result, place.begin + text.size() + tail.size());
  put_little_endian(result, text.size());
  put_little_endian(result, json_chunk);
  result += text;
  result += tail;
  return result;
}

}  // namespace

std::optional<GltfSource> prepare_gltf(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  if (bytes.starts_with("glTF") && bytes.size() >= 8 && little_endian_at(bytes, 4) == 1) return std::nullopt;
  const JsonRange place = find_json(path, bytes);
  json document = parse(path, std::string_view(bytes).substr(place.begin, place.size));
  if (!member(document, "nodes").is_array()) {
    if (member(document, "nodes").is_object()) return std::nullopt;
    fail(path, "key 'nodes': there is no list of nodes; export the file again");
  }
  check_gltf(path, document);
  GltfSource source;
  name_nodes(document);
  move_weights(document);
  add_bind_matrices(document);
  note_interpolation(path, document, source);
  name_meshes(document, source);
  source.bytes = with_json(bytes, place, document);
  return source;
}

}  // namespace graze::io
