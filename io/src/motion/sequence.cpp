#include <algorithm>
#include <cstdint>
#include <fstream>
#include <graze/io/motion.hpp>
#include <graze/io/printable.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/object_file.hpp"
#include "mesh/raw_object.hpp"
#include "motion/frame_faces.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"
#include "text/opened_files.hpp"
#include "text/text_lines.hpp"

namespace graze::io {
namespace {

/// A file name with a run of # in it.
struct NamePattern {
  std::string before;
  std::string after;
  std::size_t digits = 0;

  explicit NamePattern(const std::filesystem::path& pattern) {
    const std::string name = pattern.filename().string();
    const auto begin = name.find('#');
    if (begin == std::string::npos)
      fail(pattern, "the file name has no #; put a run of # where the number stands");
    const auto end = std::min(name.find_first_not_of('#', begin), name.size());
    if (name.find('#', end) != std::string::npos)
      fail(pattern, "the file name has several runs of #; leave one");
    before = name.substr(0, begin);
    after = name.substr(end);
    digits = end - begin;
  }

  [[nodiscard]] std::optional<std::uint64_t> number_in(std::string_view name) const {
    if (name.size() < before.size() + digits + after.size() || !name.starts_with(before) ||
        !name.ends_with(after))
      return std::nullopt;
    const std::string_view number = name.substr(before.size(), name.size() - before.size() - after.size());
    if (number.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    return parse_number<std::uint64_t>(number);
  }
};

/// The files of the pattern in order of their numbers.
std::vector<std::filesystem::path> find_files(const std::filesystem::path& pattern) {
  const NamePattern name(pattern);
  const auto folder = pattern.has_parent_path() ? pattern.parent_path() : std::filesystem::path(".");
  std::error_code error;
  std::vector<std::pair<std::uint64_t, std::filesystem::path>> numbered;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (const auto number = name.number_in(entry->path().filename().string()))
      numbered.emplace_back(*number, entry->path());
  if (error) fail(pattern, joined("its folder cannot be read (", error.message(), "); check the path"));
  if (numbered.empty()) fail(pattern, "no file has such a name; check the path and the number of #");
  std::sort(numbered.begin(), numbered.end());
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    if (i > 0 && numbered[i].first == numbered[i - 1].first)
      fail(pattern, joined("'", numbered[i - 1].second.filename().string(), "' and '",
                           numbered[i].second.filename().string(), "' have one number; remove one of them"));
    files.push_back(numbered[i].second);
  }
  return files;
}

/// Whether a file is a text that does not end with the end of a line.
bool ends_within_line(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  constexpr std::size_t head_bytes = 64;
  if (extension == ".ply" && read_bytes(path, head_bytes).find("format ascii") == std::string::npos)
    return false;
  if (extension != ".ply" && extension != ".obj" && extension != ".off") return false;
  std::ifstream stream = open_input(path);
  stream.seekg(-1, std::ios::end);
  const int last = stream.get();
  return last != '\n' && last != '\r';
}

/// What a sequence moves: a mesh, and where it came from.
struct MovedObject {
  const Mesh& mesh;
  std::size_t index = 0;                          ///< of the object in each file
  std::vector<std::uint32_t> file_vertices = {};  ///< as in LoadedObject
  std::uint32_t file_vertex_count = 0;
};

class Sequence final : public PositionSource {
 public:
  Sequence(std::vector<std::filesystem::path> files, MovedObject object, const ReadOptions& options)
      : files_(std::move(files)),
        vertex_count_(object.mesh.vertex_count()),
        object_(object.index),
        options_(options),
        file_vertices_(std::move(object.file_vertices)),
        file_vertex_count_(object.file_vertex_count),
        faces_(object.mesh) {
    if (file_vertices_.empty())
      for (std::size_t frame = 0; frame < files_.size(); ++frame) check_header(frame);
    first_ends_within_line_ = ends_within_line(files_[0]);
    std::vector<Eigen::Vector3d> positions;
    const OpenedFiles opened;
    read(0, positions);
    for (const std::filesystem::path& file : files_) OpenedFiles::add(file);
    // A frame that names other files, such as a buffer of glTF, has to be read to know them.
    const bool names_others = opened.paths().size() > files_.size();
    for (std::uint32_t frame = 1; names_others && frame < files_.size(); ++frame) read(frame, positions);
  }

  [[nodiscard]] std::uint32_t frame_count() const override {
    return static_cast<std::uint32_t>(files_.size());
  }

  [[nodiscard]] std::span<const std::string> warnings() const override { return warnings_; }

  void read(std::uint32_t frame, std::vector<Eigen::Vector3d>& positions) override {
    const std::size_t number = std::min<std::size_t>(frame, files_.size() - 1);
    auto objects = read_objects(files_[number], options_).file.objects;
    if (object_ >= objects.size())
      fail(files_[number], joined("frame ", number, ": there is no object ", object_,
                                  " (counted from 0); give every frame the mesh's objects"));
    RawObject& object = objects[object_];
    const bool is_of_file = object.file_vertices.empty() && !file_vertices_.empty() &&
                            object.surface.positions.size() == file_vertex_count_;
    if (!is_of_file) require_count(number, object.surface.positions.size());
    note_differences(number, object, is_of_file);
    if (!is_of_file) {
      positions = std::move(object.surface.positions);
      return;
    }
    positions.clear();
    for (const std::uint32_t vertex : file_vertices_) positions.push_back(object.surface.positions[vertex]);
  }

 private:
  void check_header(std::size_t frame) const {
    const std::string extension = lower_extension(files_[frame]);
    if (extension == ".ply") require_count(frame, announced_ply_vertices(files_[frame]));
    if (extension == ".off") require_count(frame, announced_off_vertices(files_[frame]));
  }

  void require_count(std::size_t frame, std::uint64_t count) const {
    if (count != vertex_count_)
      fail(files_[frame], joined("frame ", frame, ": the file has ", count, " vertices, the mesh ",
                                 vertex_count_, "; write every frame with the mesh's vertices"));
  }

  /// Each kind of difference is said once, of the first frame that has it.
  void note_differences(std::size_t frame, const RawObject& object, bool is_of_file) {
    if (!has_cut_line_ && !first_ends_within_line_ && ends_within_line(files_[frame])) {
      has_cut_line_ = true;
      note(frame,
           "it ends within a line, as the first frame does not, so its last number may be cut; "
           "write it again");
    }
    if (has_other_faces_ || is_of_file) return;
    std::string difference = object.file_vertices == file_vertices_
                                 ? faces_.difference(object.surface)
                                 : "its faces use other vertices of the file than the mesh's";
    if (difference.empty()) return;
    has_other_faces_ = true;
    note(frame, difference + "; write every frame with the mesh's faces");
  }

  void note(std::size_t frame, const std::string& what) {
    warnings_.push_back(
        shortened(printable(joined(files_[frame].string(), ": frame ", frame, ": ", what)), longest_message));
  }

  std::vector<std::filesystem::path> files_;
  std::size_t vertex_count_;
  std::size_t object_;
  ReadOptions options_;
  std::vector<std::uint32_t> file_vertices_;
  std::uint32_t file_vertex_count_;
  FrameFaces faces_;
  bool first_ends_within_line_ = false;
  bool has_cut_line_ = false;
  bool has_other_faces_ = false;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<PositionSource> open_sequence(const std::filesystem::path& pattern, const Mesh& mesh,
                                              std::size_t object_index, const ReadOptions& options) {
  return std::make_unique<Sequence>(find_files(pattern), MovedObject{mesh, object_index}, options);
}

std::unique_ptr<PositionSource> open_sequence(const std::filesystem::path& pattern,
                                              const LoadedObject& object, std::size_t object_index,
                                              const ReadOptions& options) {
  return std::make_unique<Sequence>(
      find_files(pattern),
      MovedObject{*object.mesh, object_index, object.file_vertices, object.file_vertex_count}, options);
}

}  // namespace graze::io
