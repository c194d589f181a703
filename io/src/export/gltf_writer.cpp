#include <Eigen/Geometry>
#include <algorithm>
#include <graze/io/gltf_writer.hpp>
#include <limits>

#include "export/base64.hpp"
#include "export/gltf_data.hpp"
#include "export/output_file.hpp"
#include "export/snapshot_objects.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

// Numbers that glTF takes from OpenGL.
constexpr int drawn_points = 0;
constexpr int drawn_triangles = 4;

// The materials of a written file, by their index in it.
constexpr int surface_material = 0;
constexpr int contact_material = 1;

nlohmann::json written_materials() {
  const auto material = [](const char* name, nlohmann::json colour) -> nlohmann::json {
    return {{"name", name},
            {"doubleSided", true},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", std::move(colour)}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
  };
  return {material("surface", {0.6, 0.7, 0.8, 1}), material("contact", {0.9, 0.1, 0.1, 1})};
}

/// A mesh's only primitive, and where the node of the mesh stands.
struct WrittenMesh {
  nlohmann::json primitive;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double size = 0;
};

/// The origin of points that are further from 0 than they are large. A float of their coordinates would lose
/// their shape, so that the distance from the origin is written. The origin itself is a float without loss.
Eigen::Vector3d origin_of(const Eigen::AlignedBox3d& box, double size) {
  constexpr double far = 16;
  const Eigen::Vector3d centre = box.center();
  if (!centre.allFinite() || !(centre.cwiseAbs().maxCoeff() > far * size)) return Eigen::Vector3d::Zero();
  return centre.cast<float>().cast<double>();
}

Eigen::AlignedBox3d box_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  return box;
}

std::vector<Eigen::Vector3f> around(const Eigen::Vector3d& origin,
                                    const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3f> positions;
  for (const Eigen::Vector3d& point : points) positions.emplace_back((point - origin).cast<float>());
  return positions;
}

/// The mesh of an object: the triangles of all faces.
WrittenMesh surface_mesh(const SnapshotObject& object, GltfData& data) {
  std::vector<Eigen::Vector3d> points;
  for (std::uint32_t vertex = 0; vertex < object.mesh->vertex_count(); ++vertex)
    points.push_back(exported_position(object, vertex));
  const Eigen::AlignedBox3d box = box_of(points);
  const double size = box.sizes().maxCoeff();
  const Eigen::Vector3d origin = origin_of(box, size);
  std::vector<std::uint32_t> corners;
  for (std::uint32_t index = 0; index < object.mesh->face_count(); ++index) {
    const auto face = object.mesh->face(index);
    for (std::size_t last = 2; last < face.size(); ++last)
      corners.insert(corners.end(), {face[0], face[last - 1], face[last]});
  }
  return {{{"attributes", {{"POSITION", data.add_positions(around(origin, points))}}},
           {"indices", data.add_indices(corners)},
           {"mode", drawn_triangles},
           {"material", surface_material}},
          origin,
          size};
}

/// The mesh of the contacts: their points on object a, with normals and distances. `object_size` is that of
/// the smallest object.
WrittenMesh contact_mesh(std::span<const Contact> contacts, double object_size, GltfData& data) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> distances;
  for (const Contact& contact : contacts) {
    points.push_back(contact.point_a);
    normals.push_back(contact.normal.cast<float>());
    distances.push_back(static_cast<float>(contact.distance));
  }
  const Eigen::AlignedBox3d box = box_of(points);
  const Eigen::Vector3d origin = origin_of(box, std::max(box.sizes().maxCoeff(), object_size));
  return {{{"attributes",
            {{"POSITION", data.add_positions(around(origin, points))},
             {"NORMAL", data.add_normals(normals)},
             {"_DISTANCE", data.add_scalars(distances)}}},
           {"mode", drawn_points},
           {"material", contact_material}},
          origin,
          0};
}

/// All of a file but its data. Each node has a mesh of the same index.
nlohmann::json written_scene(const SceneSnapshot& snapshot, GltfData& data) {
  nlohmann::json nodes = nlohmann::json::array();
  nlohmann::json meshes = nlohmann::json::array();
  const auto add_node = [&](const std::string& name, WrittenMesh written) -> nlohmann::json& {
    nlohmann::json node = {{"mesh", meshes.size()}};
    if (!written.origin.isZero(0))
      node["translation"] = {written.origin.x(), written.origin.y(), written.origin.z()};
    nlohmann::json mesh = {{"primitives", nlohmann::json::array({std::move(written.primitive)})}};
    if (!name.empty()) node["name"] = mesh["name"] = name;
    meshes.push_back(std::move(mesh));
    nodes.push_back(std::move(node));
    return nodes.back();
  };
  double smallest = std::numeric_limits<double>::infinity();
  for (const SnapshotObject& object : snapshot.objects) {
    WrittenMesh mesh = surface_mesh(object, data);
    smallest = std::min(smallest, mesh.size);
    add_node(object.name, std::move(mesh))["extras"] = {{"object", object.serial}};
  }
  const auto contacts = snapshot.report->contacts();
  if (!contacts.empty()) add_node("contacts", contact_mesh(contacts, smallest, data));
  std::vector<std::size_t> roots(nodes.size());
  for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = i;
  return {{"asset", {{"version", "2.0"}, {"generator", "graze"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", roots}, {"extras", {{"frame", snapshot.frame}}}}}},
          {"nodes", std::move(nodes)},
          {"meshes", std::move(meshes)},
          {"materials", written_materials()},
          {"accessors", data.accessors()},
          {"bufferViews", data.views()}};
}

/// Names may hold anything. Bytes that are not UTF-8 are replaced.
std::string dumped(const nlohmann::json& root) {
  return root.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_word(std::string& bytes, std::size_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255U);
}

/// A binary file: a head, a chunk of JSON and a chunk of data. The length of each chunk is a multiple of 4.
std::string binary_head(const std::filesystem::path& path, std::string text, std::size_t data_size) {
  text.append((4 - text.size() % 4) % 4, ' ');
  const std::size_t size = 12 + 8 + text.size() + 8 + data_size;
  if (size > std::numeric_limits<std::uint32_t>::max())
    fail(path, "the frame has more than 4 GB, which a binary file cannot hold; end the name in .gltf");
  std::string head = "glTF";
  append_word(head, 2);
  append_word(head, size);
  append_word(head, text.size());
  head += "JSON" + text;
  append_word(head, data_size);
  head.append("BIN\0", 4);
  return head;
}

}  // namespace

void write_gltf(const std::filesystem::path& path, const SceneSnapshot& snapshot) {
  if (snapshot.objects.empty()) fail(path, "the frame has no object; choose another frame");
  GltfData data;
  nlohmann::json root = written_scene(snapshot, data);
  nlohmann::json buffer = {{"byteLength", data.bytes().size()}};
  const bool is_binary = lower_extension(path) == ".glb";
  if (!is_binary) buffer["uri"] = "data:application/octet-stream;base64," + base64_encoded(data.bytes());
  root["buffers"] = nlohmann::json::array({std::move(buffer)});
  OutputFile file(path);
  if (is_binary) {
    file.write(binary_head(path, dumped(root), data.bytes().size()));
    file.write(data.bytes());
  } else {
    file.write(dumped(root));
  }
  file.close();
}

}  // namespace graze::io
