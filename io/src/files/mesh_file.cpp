#include <algorithm>
#include <cstdint>
#include <graze/error.hpp>
#include <graze/io/mesh_file.hpp>
#include <graze/io/printable.hpp>
#include <utility>

#include "assimp/read_assimp.hpp"
#include "files/object_file.hpp"
#include "formats/read_stl.hpp"
#include "gltf/read_gltf.hpp"
#include "mesh/raw_object.hpp"
#include "mesh/rig.hpp"
#include "text/file_bytes.hpp"
#include "text/out_of_memory.hpp"
#include "text/text_lines.hpp"
#include "text/unique_names.hpp"

namespace graze::io {

struct MeshFile::Content {
  static std::shared_ptr<const Content> read(const std::filesystem::path& path, const ReadOptions& options);

  std::vector<LoadedObject> objects;
  std::vector<std::string> animations;
  std::vector<std::string> warnings;
  FileFrame frame;
  Rig rig;                           ///< its bodies are those of the animated objects only
  std::vector<std::size_t> body_of;  ///< for each object, no_body where it is not animated

  static constexpr std::size_t no_body = static_cast<std::size_t>(-1);
};

namespace {

void note_cuts(const std::filesystem::path& path, const std::string& object, const CutFaces& cut,
               std::vector<std::string>& warnings) {
  if (cut.too_complex)
    fail(path, joined("object '", object, "': face ", *cut.too_complex,
                      " (counted from 0) has too many corners; cut it into triangles in your modeller"));
  if (cut.faces == 0) return;
  warnings.push_back(joined(path.string(), ": object '", object, "': ", cut.faces,
                            " faces with more than 4 corners were cut into ", cut.triangles, " triangles"));
}

}  // namespace

RiggedFile read_objects(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string extension = lower_extension(path);
  if (extension == ".obj") return {read_obj(path), {}, {}};
  if (extension == ".ply") return {read_ply(path), {}, {}};
  if (extension == ".off") return {read_off(path), {}, {}};
  if (extension == ".stl") return {read_stl(path), {}, {}};
  if (extension == ".gltf" || extension == ".glb") return read_gltf(path, options);
  return read_assimp(path, options);
}

MeshFile::MeshFile(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

MeshFile MeshFile::read(const std::filesystem::path& path, const ReadOptions& options) {
  return with_memory_for(path, [&] { return MeshFile(Content::read(path, options)); });
}

std::shared_ptr<const MeshFile::Content> MeshFile::Content::read(const std::filesystem::path& path,
                                                                 const ReadOptions& options) {
  RiggedFile source = read_objects(path, options);
  auto content = std::make_shared<Content>();
  content->warnings = std::move(source.file.warnings);
  std::vector<Body> bodies;
  const MovedNodes moved(source.rig);
  UniqueNames names;
  for (std::size_t i = 0; i < source.file.objects.size(); ++i) {
    RawObject& object = source.file.objects[i];
    if (object.surface.corner_counts.empty()) continue;
    const std::string wanted = object.name.empty() ? path.stem().string() : object.name;
    LoadedObject loaded{names.make(shortened(wanted, longest_name)), nullptr,
                        i < source.rig.bodies.size() && moved.move(source.rig.bodies[i])};
    note_cuts(path, loaded.name, cut_large_faces(object.surface), content->warnings);
    loaded.mesh = make_mesh(path, loaded.name, object.surface, object.file_vertices);
    object.surface = {};
    loaded.file_vertices = std::move(object.file_vertices);
    loaded.file_vertex_count = object.file_vertex_count;
    content->body_of.push_back(loaded.animated ? bodies.size() : Content::no_body);
    if (loaded.animated) bodies.push_back(std::move(source.rig.bodies[i]));
    content->objects.push_back(std::move(loaded));
  }
  if (content->objects.empty()) fail(path, "there is no face in it; a mesh needs at least one");
  for (std::string& warning : content->warnings) warning = shortened(printable(warning), longest_message);
  content->frame = std::move(source.frame);
  source.rig.bodies = std::move(bodies);
  for (const auto& clip : source.rig.clips) content->animations.push_back(clip.name);
  content->rig = std::move(source.rig);
  return content;
}

std::span<const LoadedObject> MeshFile::objects() const {
  return content_->objects;
}

std::span<const std::string> MeshFile::animations() const {
  return content_->animations;
}

std::span<const std::string> MeshFile::warnings() const {
  return content_->warnings;
}

const FileFrame& MeshFile::frame() const {
  return content_->frame;
}

double MeshFile::animation_seconds(std::size_t animation) const {
  if (animation >= content_->rig.clips.size())
    throw Error(
        joined("mesh file: animation ", animation, " of ", content_->rig.clips.size(), " does not exist"));
  return content_->rig.clips[animation].seconds;
}

void MeshFile::animate(std::size_t object, std::size_t animation, double seconds,
                       std::vector<Eigen::Vector3d>& positions) const {
  const double end = animation_seconds(animation);
  if (object >= content_->objects.size())
    throw Error(joined("mesh file: object ", object, " of ", content_->objects.size(), " does not exist"));
  const std::size_t body = content_->body_of[object];
  if (body == Content::no_body) {
    const auto rest = content_->objects[object].mesh->rest();
    positions.assign(rest.begin(), rest.end());
    return;
  }
  const double clamped = seconds > 0 ? std::min(seconds, end) : 0.0;
  pose(content_->rig, content_->rig.bodies[body], &content_->rig.clips[animation], clamped, positions);
}

}  // namespace graze::io
