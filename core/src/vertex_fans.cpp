#include "vertex_fans.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace graze {
namespace {

/// The triangles about one vertex, in the order in which they share edges.
class Fans {
 public:
  void begin(std::uint32_t vertex) {
    vertex_ = vertex;
    links_.clear();
  }
  void add_face(std::span<const std::uint32_t> face) {
    for (std::size_t last = 2; last < face.size(); ++last) {
      const std::uint32_t corner[] = {face[0], face[last - 1], face[last]};
      for (std::size_t i = 0; i < 3; ++i)
        if (corner[i] == vertex_) add_link(corner[(i + 1) % 3], corner[(i + 2) % 3]);
    }
  }
  /// Open fans first, so that none is begun in its middle.
  void write(std::vector<std::uint32_t>& fans) {
    std::sort(links_.begin(), links_.end());
    for (const Link& link : links_)
      for (std::size_t next = first_from(link.to); is_from(next, link.to); ++next)
        links_[next].follows_another = true;
    const std::size_t begin = fans.size();
    for (const bool is_closed : {false, true})
      for (std::size_t first = 0; first < links_.size(); ++first)
        if (!links_[first].is_written && (is_closed || !links_[first].follows_another)) {
          if (fans.size() > begin) fans.push_back(vertex_);
          write_fan(first, fans);
        }
  }

 private:
  /// From one vertex around to the next, by a triangle.
  struct Link {
    std::uint32_t from = 0, to = 0;
    bool follows_another = false;
    bool is_written = false;

    friend bool operator<(const Link& a, const Link& b) {
      return std::pair(a.from, a.to) < std::pair(b.from, b.to);
    }
  };

  void add_link(std::uint32_t from, std::uint32_t to) {
    if (from != to && from != vertex_ && to != vertex_) links_.push_back({from, to});
  }
  [[nodiscard]] std::size_t first_from(std::uint32_t vertex) const {
    return static_cast<std::size_t>(std::lower_bound(links_.begin(), links_.end(), Link{vertex, 0}) -
                                    links_.begin());
  }
  [[nodiscard]] bool is_from(std::size_t link, std::uint32_t vertex) const {
    return link < links_.size() && links_[link].from == vertex;
  }
  void write_fan(std::size_t link, std::vector<std::uint32_t>& fans) {
    fans.push_back(links_[link].from);
    std::uint32_t last = links_[link].from;
    do {
      links_[link].is_written = true;
      last = links_[link].to;
      fans.push_back(last);
      for (link = first_from(last); is_from(link, last) && links_[link].is_written;) ++link;
    } while (is_from(link, last));
  }

  std::uint32_t vertex_ = 0;
  std::vector<Link> links_;
};

}  // namespace

void list_fans(const Mesh& mesh, std::vector<std::uint32_t>& fans, std::vector<std::uint32_t>& begin) {
  begin.reserve(std::size_t{mesh.vertex_count()} + 1);
  begin.push_back(0);
  Fans of_vertex;
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
    of_vertex.begin(vertex);
    for (const std::uint32_t face : mesh.vertex_faces(vertex)) of_vertex.add_face(mesh.face(face));
    of_vertex.write(fans);
    begin.push_back(static_cast<std::uint32_t>(fans.size()));
  }
}

}  // namespace graze
