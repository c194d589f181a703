// Writes the inputs that fuzzers start from: make_corpus FOLDER [ASSIMP_MODELS]. FOLDER gets a folder for
// each target. Of assimp's test models the small ones of our formats are taken.

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <graze/enumerators.hpp>
#include <graze/graze.hpp>
#include <graze/io/report_json.hpp>
#include <graze/recorder.hpp>
#include <iostream>
#include <limits>

#include "fuzz/files/gltf_texts.hpp"
#include "fuzz/files/mesh_text.hpp"
#include "fuzz/files/scene_files.hpp"
#include "fuzz/pair/pair_case.hpp"
#include "fuzz/scenes/report_meshes.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::fuzz {
namespace {

/// One target's folder.
class Seeds {
 public:
  Seeds(const std::filesystem::path& corpus, const std::string& target) : folder_(corpus / target) {
    std::filesystem::create_directories(folder_);
  }

  void add(const std::string& bytes) {
    std::ofstream(folder_ / ("seed_" + std::to_string(count_++)), std::ios::binary) << bytes;
  }
  /// Bytes by chance, for targets that build their case from them.
  void add_random(std::uint64_t seed, std::size_t size) {
    oracle::Random random(seed);
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(random.below(256));
    add(bytes);
  }
  [[nodiscard]] std::filesystem::path next_path(const std::string& ending = "") {
    return folder_ / ("seed_" + std::to_string(count_++) + ending);
  }

 private:
  std::filesystem::path folder_;
  std::size_t count_ = 0;
};

template <typename Number>
std::string bytes_of(Number number, bool is_big_endian) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  if (is_big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string binary_ply(bool is_big_endian) {
  std::string text = "ply\nformat binary_" + std::string(is_big_endian ? "big" : "little") +
                     "_endian 1.0\ncomment four corners\nelement vertex 4\nproperty double x\n"
                     "property float y\nproperty short z\nproperty uchar red\nelement face 2\n"
                     "property list uchar uint vertex_index\nelement tristrips 1\n"
                     "property list int int vertex_indices\nend_header\n";
  for (int i = 0; i < 4; ++i)
    text += bytes_of(0.5 * i, is_big_endian) + bytes_of(static_cast<float>(i * i), is_big_endian) +
            bytes_of(static_cast<std::int16_t>(i % 2), is_big_endian) +
            bytes_of(std::uint8_t{7}, is_big_endian);
  for (const std::vector<std::uint32_t>& face : {std::vector<std::uint32_t>{0, 1, 2, 3}, {3, 1, 0}}) {
    text += static_cast<char>(face.size());
    for (const std::uint32_t corner : face) text += bytes_of(corner, is_big_endian);
  }
  for (const int number : {7, 0, 1, 2, 3, -1, 2, 1}) text += bytes_of(number, is_big_endian);
  return text;
}

std::vector<std::string> mesh_texts(MeshFormat format) {
  io::RawSurface surface;
  surface.positions = {{0, 0, 0}, {1, -0.0, 1e-310}, {1, 1, 0.1}, {0, 1, -1e300}, {0.5, 2, 0}};
  for (const std::vector<std::uint32_t>& face :
       {std::vector<std::uint32_t>{0, 1, 2, 3}, {3, 2, 4}, {0, 1, 2, 4, 3}})
    surface.add_face(face);
  std::vector<std::string> texts = {mesh_text(format, surface)};
  surface.positions.emplace_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  texts.push_back(mesh_text(format, surface));
  if (format == MeshFormat::obj)
    texts.emplace_back(
        "# two\no box\nv 0 0 0\nv 1e2 0 0 \\\n\nv +0 1 0\ng a\nf 1//2 2/1 -1/3/4\ng b\r\nf 3 2 1 1\n");
  if (format == MeshFormat::off)
    texts.emplace_back("COFF 3 1 0 # c\n0 0 0 1 1 1 1\n1 0 0\n0 1 0\n\n3 0 1 2 255\n");
  if (format == MeshFormat::ply) {
    texts.push_back(binary_ply(false));
    texts.push_back(binary_ply(true));
  }
  return texts;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Gives the first pair of a report a way out, and its first contact what edges that are sunk have.
std::string with_sunk_pair(std::string report) {
  const auto insert_before = [&](const std::string& key, const std::string& more) {
    const std::size_t at = report.find(key);
    if (at != std::string::npos) report.insert(at, more);
  };
  insert_before(
      "\"contacts\":[",
      R"("way_out":{"direction":[0,0,1],"point":[1,2,3],"fullness":0.5,"thickness":0.25,"extent":2},)");
  insert_before("\"since\":", R"("sunk":true,)");
  return report;
}

/// Writes seeds with the reports about a few moving objects, at every detail.
void write_reports(Seeds& seeds) {
  for (const ContactDetail detail : enumerators<ContactDetail>) {
    SceneSettings settings;
    settings.contact_distance = 0.25;
    settings.range = detail == ContactDetail::none ? std::numeric_limits<double>::infinity() : 2;
    settings.detail = detail;
    if (detail == ContactDetail::regions) settings.accuracy = Accuracy::paper({1, 0.5});
    if (detail == ContactDetail::closest) settings.work_budget = 3;
    if (detail == ContactDetail::nearest) settings.max_contacts = 4;
    if (detail == ContactDetail::features) settings.max_contacts_per_pair = 2;
    if (detail == ContactDetail::nearest) settings.carrying = 3;
    settings.ways_out = detail == ContactDetail::nearest;
    settings.threads = 1;
    Scene scene(settings);
    std::vector<io::SceneObject> objects;
    for (const std::uint32_t count : {3U, 4U, 5U}) {
      const auto mesh = report_mesh(count, 2);
      const std::string name = "o\"" + std::to_string(count);
      objects.push_back({scene.add(mesh, {.name = name}), name, mesh});
    }
    const std::string ending = detail == ContactDetail::closest ? ".gz" : "";
    const std::filesystem::path path = seeds.next_path(ending);
    io::ReportWriter writer(path, objects, settings,
                            {.include_times = detail == ContactDetail::none,
                             .include_contacts = detail != ContactDetail::vertices});
    std::vector<Eigen::Vector3d> positions(3, Eigen::Vector3d(0, 0.125, 0));
    for (std::uint64_t frame = 0; frame < 2; ++frame) {
      scene.set_positions(objects[0].id, positions);
      writer.write(frame, *scene.step());
      positions[1].x() = std::numeric_limits<double>::infinity();
    }
    writer.close();
    if (detail == ContactDetail::features) seeds.add(with_sunk_pair(read(path)));
  }
}

/// A tetrahedron of this size.
std::shared_ptr<const Mesh> solid_mesh(double size) {
  const std::vector<Eigen::Vector3d> rest = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(rest, faces));
}

/// Writes seeds with recordings of a few objects that are moved in every way, one of them badly.
void write_recordings(Seeds& seeds) {
  for (const ContactDetail detail : enumerators<ContactDetail>) {
    SceneSettings settings;
    settings.contact_distance = 0.25;
    settings.range = 2;
    settings.detail = detail;
    settings.threads = 1;
    if (detail == ContactDetail::none) settings.region_distances = 16;
    if (detail == ContactDetail::nearest) settings.max_contacts = 4;
    if (detail == ContactDetail::features) settings.max_contacts_per_pair = 2;
    settings.ways_out = true;
    settings.carrying = 2;
    settings.carrying_band = 0.125;
    std::vector<Eigen::Vector3d> bound(4, Eigen::Vector3d(0, 0.125, 0));
    const std::vector<Eigen::Vector3f> copied(3, Eigen::Vector3f(0.5F, 0, 0));
    Scene scene(settings);
    Recorder recorder(scene, seeds.next_path(), {.keyframe_interval = 2, .waiting_frames = 64});
    const ObjectId first = scene.add(report_mesh(3, 2), {.name = "first"});
    const ObjectId second = scene.add(report_mesh(4, 2), {.margin = 0.5, .kind = 2});
    const ObjectId third = scene.add(report_mesh(5, 2), {.motion = Motion::rigid});
    const ObjectId fourth =
        scene.add(solid_mesh(1), {.solid = true, .face_groups = {0, 1, 1, 0}, .hidden_groups = {1}});
    scene.set_rule(0, 2, {0.5, 3, {}});
    scene.ignore(first, 0, fourth, 1);
    scene.bind_positions(second, bound);
    (void)scene.step(7);
    scene.set_positions(first, copied, 0.5);
    scene.set_pose_rows(third, {1, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0});
    scene.ignore(first, third);
    scene.replace_mesh(fourth, solid_mesh(0.5), std::vector<std::uint32_t>{1, 0, Mesh::no_vertex, 3});
    (void)scene.step();
    bound[1].x() = std::numeric_limits<double>::infinity();
    scene.set_pose_rows(third, {2, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0});
    (void)scene.step();
    scene.unbind_positions(second);
    scene.remove(third);
    (void)scene.step();
    recorder.close();
  }
}

/// A binary file of two faces whose header begins with "solid", and texts of one and two solids.
std::vector<std::string> stl_texts() {
  std::string binary = "solid binary" + std::string(68, ' ') + bytes_of(std::uint32_t{2}, false);
  for (int i = 0; i < 24; ++i)
    binary += bytes_of(static_cast<float>(i % 5), false) + (i % 12 == 11 ? "ab" : "");
  const std::string face =
      "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 -1.#IND\n "
      "endloop\nendfacet\n";
  return {binary, binary + "tail", "solid a b\n" + face + "endsolid a b\n",
          "SOLID a\n" + face + face + "end solid\nsolid\n" + face + "endsolid"};
}

/// The models that are small enough to be mutated usefully.
void add_models(const std::filesystem::path& models, Seeds& mesh_seeds, Seeds& gltf_seeds) {
  constexpr std::uintmax_t largest = 16384;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(models))
    if (entry.is_regular_file() && entry.file_size() > 0 && entry.file_size() <= largest)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const std::string extension = file.extension().string();
    if (extension == ".gltf" || extension == ".glb")
      gltf_seeds.add((extension == ".glb" ? '\1' : '\0') + read(file));
    for (std::size_t i = 0; i < mesh_formats.size(); ++i)
      if (extension == extension_of(mesh_formats[i])) mesh_seeds.add(static_cast<char>(i) + read(file));
  }
}

void make_corpus(const std::filesystem::path& corpus, const std::filesystem::path& models) {
  Seeds mesh_seeds(corpus, "mesh_text");
  Seeds motion_seeds(corpus, "motion_file");
  for (std::size_t i = 0; i < mesh_formats.size(); ++i)
    for (const std::string& text : mesh_texts(mesh_formats[i])) {
      mesh_seeds.add(static_cast<char>(i) + text);
      std::string sequence = {static_cast<char>(2 + i), 4};  // of five vertices, as the first text has
      for (int frame = 0; frame < 2; ++frame)
        sequence.append(bytes_of(static_cast<std::uint16_t>(text.size()), false)).append(text);
      motion_seeds.add(sequence);
    }
  motion_seeds.add(std::string("\0\2", 2) + cache_seed(true, 3, 2));
  motion_seeds.add(std::string("\1\0", 2) + cache_seed(false, 1, 3));

  Seeds scene_seeds(corpus, "scene_file");
  for (const std::string& text : scene_file_seeds()) scene_seeds.add(text);
  Seeds gltf_seeds(corpus, "gltf");
  for (const std::string& text : gltf_texts()) gltf_seeds.add('\0' + text);
  Seeds stl_seeds(corpus, "stl");
  for (const std::string& text : stl_texts()) stl_seeds.add(text);
  Seeds report_seeds(corpus, "report_json");
  write_reports(report_seeds);
  Seeds recording_seeds(corpus, "recording");
  write_recordings(recording_seeds);
  for (std::uint64_t seed = 0; seed < 40; ++seed) recording_seeds.add_random(2000 + seed, 60 + 20 * seed);
  Seeds assimp_seeds(corpus, "assimp_data");
  for (std::uint64_t seed = 0; seed < 40; ++seed) assimp_seeds.add_random(seed, 100 + 40 * seed);
  Seeds pair_seeds(corpus, "pair");
  for (std::uint64_t seed = 0; seed < 240; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    constexpr auto details = enumerators<ContactDetail>;
    pair_seeds.add(pair_case_bytes({scene.a, scene.b, scene.threshold}, details[seed / 8 % details.size()]));
  }
  Seeds step_seeds(corpus, "scene_steps");
  for (std::uint64_t seed = 0; seed < 60; ++seed) step_seeds.add_random(1000 + seed, 200 + 20 * seed);
  if (!models.empty()) add_models(models, mesh_seeds, gltf_seeds);
}

}  // namespace
}  // namespace graze::fuzz

int main(int count, char** arguments) {
  if (count < 2) {
    std::cerr << "usage: make_corpus FOLDER [ASSIMP_MODELS]\n";
    return 2;
  }
  graze::fuzz::make_corpus(arguments[1], count > 2 ? arguments[2] : "");
  return 0;
}
