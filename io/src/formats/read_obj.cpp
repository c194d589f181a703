// Reads OBJ files. graze does not use tinyobjloader (2.0.0rc10) for this. That library reads missing,
// unreadable and NaN coordinates as 0, and rounds decimals wrongly by some units in the last place. It lets
// large indices wrap around, and knows neither continued lines nor comments behind a statement. The tests
// compare both where both are right.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/raw_object.hpp"
#include "mesh/used_vertices.hpp"
#include "mesh/vertex_text.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"
#include "text/text_lines.hpp"

namespace graze::io {
namespace {

/// Statements of an OBJ file: lines without comments, a backslash at the end of a line joining it with the
/// next.
class Statements {
 public:
  explicit Statements(std::string_view text)
      : lines_(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text) {}

  bool next() {
    statement_.clear();
    if (lines_.at_end()) return false;
    first_line_ = lines_.line() + 1;
    while (!lines_.at_end()) {
      std::string_view line = lines_.next();
      line = trimmed(without_comment(line));
      const bool continued = line.ends_with('\\');
      if (continued) line.remove_suffix(1);
      statement_ += line;
      if (!continued) break;
      statement_ += ' ';
    }
    return true;
  }

  [[nodiscard]] std::string_view text() const { return statement_; }
  /// Counted from 1.
  [[nodiscard]] std::size_t line() const { return first_line_; }

 private:
  TextLines lines_;
  std::string statement_;
  std::size_t first_line_ = 0;
};

struct Group {
  std::string name;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> corner_counts;
};

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& path) : path_(path) {}

  RawFile read(std::string_view text) {
    if (text.find('\0') != std::string_view::npos)
      fail(path_, "this is no text in ASCII or UTF-8; save it as such");
    Statements statements(text);
    while (statements.next()) {
      line_ = statements.line();
      std::string_view rest = statements.text();
      const std::string_view keyword = next_word(rest);
      if (keyword == "v")
        add_vertex(rest);
      else if (keyword == "f" || keyword == "fo")
        add_face(rest);
      else if (keyword == "o")
        start_object(rest);
      else if (keyword == "g")
        start_group(rest);
    }
    require_named_vertices();
    return result();
  }

 private:
  void add_vertex(std::string_view rest) {
    const Eigen::Vector3d position = read_vertex(rest, path_, line_);
    if (positions_.size() + 1 >= Mesh::no_edge)
      fail(path_, line_, "the file has too many vertices; split it");
    positions_.push_back(position);
  }

  void add_face(std::string_view rest) {
    face_.clear();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      face_.push_back(vertex_of(word));
    if (face_.size() < 3) {
      ++small_faces_;
      return;
    }
    Group& group = current_group();
    group.corners.insert(group.corners.end(), face_.begin(), face_.end());
    group.corner_counts.push_back(static_cast<std::uint32_t>(face_.size()));
  }

  /// A corner is v, v/vt, v//vn or v/vt/vn. v counts from 1, or back from the last vertex before the line.
  std::uint32_t vertex_of(std::string_view word) {
    const auto number = parse_number<std::int64_t>(word.substr(0, word.find('/')));
    if (!number) fail(path_, line_, joined("'", word, "' is no corner of a face; correct the line"));
    const auto count = static_cast<std::int64_t>(positions_.size());
    const std::int64_t index = *number < 0 ? count + *number : *number - 1;
    if (*number == 0 || index < 0 || index >= Mesh::no_edge) fail_face(*number);
    const auto vertex = static_cast<std::uint32_t>(index);
    if (index >= count && (!furthest_ || vertex > furthest_->first)) furthest_ = {vertex, line_};
    return vertex;
  }

  [[noreturn]] void fail_face(std::int64_t number) const {
    fail(path_, line_,
         joined("a face names vertex ", number, " of ", positions_.size(),
                "; remove the face or add the vertex"));
  }

  /// A face may come before its vertices. At the end they must be there.
  void require_named_vertices() {
    if (!furthest_ || furthest_->first < positions_.size()) return;
    line_ = furthest_->second;
    fail_face(std::int64_t{furthest_->first} + 1);
  }

  void start_object(std::string_view rest) {
    ++object_;
    object_name_ = trimmed(rest);
    group_name_.clear();
    current_ = no_group;
  }

  void start_group(std::string_view rest) {
    group_name_ = trimmed(rest);
    current_ = no_group;
  }

  /// A group that is named again within its object goes on.
  Group& current_group() {
    if (current_ == no_group) {
      const auto [entry, is_new] = group_numbers_.try_emplace({object_, group_name_}, groups_.size());
      current_ = entry->second;
      if (is_new) groups_.push_back({group_name_.empty() ? object_name_ : group_name_, {}, {}});
    }
    return groups_[current_];
  }

  RawFile result() {
    RawFile file;
    if (groups_.empty()) groups_.emplace_back();
    for (Group& group : groups_) {
      RawObject object{std::move(group.name), {{}, std::move(group.corners), std::move(group.corner_counts)}};
      if (groups_.size() == 1)
        object.surface.positions = std::move(positions_);
      else
        keep_used_vertices(object);
      file.objects.push_back(std::move(object));
    }
    if (small_faces_ > 0)
      file.warnings.push_back(
          joined(path_.string(), ": ", small_faces_, " faces with fewer than 3 corners were left out"));
    return file;
  }

  /// Groups share the file's vertices. If each kept all of them, n groups would need n times the memory.
  void keep_used_vertices(RawObject& object) const {
    const UsedVertices used(object.surface.corners, positions_.size());
    object.file_vertices = used.old_numbers();
    object.file_vertex_count = static_cast<std::uint32_t>(positions_.size());
    for (const std::uint32_t vertex : object.file_vertices)
      object.surface.positions.push_back(positions_[vertex]);
    for (std::uint32_t& corner : object.surface.corners) corner = used.new_number(corner);
  }

  static constexpr std::size_t no_group = static_cast<std::size_t>(-1);

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Group> groups_;
  std::map<std::pair<std::size_t, std::string>, std::size_t> group_numbers_;
  std::size_t object_ = 0;
  std::string object_name_;
  std::string group_name_;
  std::size_t current_ = no_group;
  std::vector<std::uint32_t> face_;
  std::size_t small_faces_ = 0;
  /// The highest vertex named before it was there, and the line that named it.
  std::optional<std::pair<std::uint32_t, std::size_t>> furthest_;
};

}  // namespace

RawFile read_obj(const std::filesystem::path& path) {
  return ObjReader(path).read(read_bytes(path));
}

}  // namespace graze::io
