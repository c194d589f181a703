#include "mesh/vertex_fans.hpp"

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
    find_heads();
    const std::size_t begin = fans.size();
    for (const bool is_closed : {false, true})
      for (const Link& link : links_)
        while ((is_closed || !links_[link.head].is_led_to) && is_left(link.head, link.from)) {
          if (fans.size() > begin) fans.push_back(vertex_);
          write_fan(link.head, fans);
        }
  }

 private:
  /// From one vertex around to the next, by a triangle. The first of those from a vertex, their head, tells
  /// of all of them whether another leads to them, and how many are written. These come first.
  struct Link {
    std::uint32_t from = 0, to = 0;
    bool is_led_to = false;
    std::uint32_t written = 0;
    std::uint32_t head = 0;       ///< the index of the first link from `from`
    std::uint32_t next_head = 0;  ///< that of the first link from `to`, or where it would be

    friend bool operator<(const Link& a, const Link& b) {
      return std::pair(a.from, a.to) < std::pair(b.from, b.to);
    }
  };

  void add_link(std::uint32_t from, std::uint32_t to) {
    if (from != to && from != vertex_ && to != vertex_) links_.push_back({from, to});
  }
  [[nodiscard]] std::size_t head_of(std::uint32_t vertex) const {
    return static_cast<std::size_t>(std::lower_bound(links_.begin(), links_.end(), Link{vertex, 0}) -
                                    links_.begin());
  }
  [[nodiscard]] bool is_from(std::size_t link, std::uint32_t vertex) const {
    return link < links_.size() && links_[link].from == vertex;
  }
  [[nodiscard]] bool is_left(std::size_t head, std::uint32_t vertex) const {
    return is_from(head, vertex) && is_from(head + links_[head].written, vertex);
  }
  /// Finds the heads of all links once, since writing asks for them several times.
  void find_heads() {
    for (std::uint32_t index = 0; index < links_.size(); ++index) {
      Link& link = links_[index];
      const bool is_first = index == 0 || links_[index - 1].from != link.from;
      link.head = is_first ? index : links_[index - 1].head;
      link.next_head = static_cast<std::uint32_t>(head_of(link.to));
      if (is_from(link.next_head, link.to)) links_[link.next_head].is_led_to = true;
    }
  }
  /// Writes the fan that begins with the next link of a head.
  void write_fan(std::size_t head, std::vector<std::uint32_t>& fans) {
    std::uint32_t vertex = links_[head].from;
    fans.push_back(vertex);
    while (is_left(head, vertex)) {
      const Link& link = links_[head + links_[head].written++];
      vertex = link.to;
      head = link.next_head;
      fans.push_back(vertex);
    }
  }

  std::uint32_t vertex_ = 0;
  std::vector<Link> links_;
};

}  // namespace

void list_fans(const IndexedMesh& mesh, std::vector<std::uint32_t>& fans, std::vector<std::uint32_t>& begin) {
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
