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
    for (const Link& link : links_)
      if (const std::size_t head = head_of(link.to); is_from(head, link.to)) links_[head].is_led_to = true;
    const std::size_t begin = fans.size();
    for (const bool is_closed : {false, true})
      for (const Link& link : links_) {
        const std::size_t head = head_of(link.from);
        while ((is_closed || !links_[head].is_led_to) && is_left(head, link.from)) {
          if (fans.size() > begin) fans.push_back(vertex_);
          write_fan(link.from, fans);
        }
      }
  }

 private:
  /// From one vertex around to the next, by a triangle. The first of those from a vertex, their head, tells
  /// of all of them whether another leads to them, and how many are written; these are the first.
  struct Link {
    std::uint32_t from = 0, to = 0;
    bool is_led_to = false;
    std::uint32_t written = 0;

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
  void write_fan(std::uint32_t vertex, std::vector<std::uint32_t>& fans) {
    fans.push_back(vertex);
    for (std::size_t head = head_of(vertex); is_left(head, vertex); head = head_of(vertex)) {
      vertex = links_[head + links_[head].written++].to;
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
