#pragma once

#include <cstdint>
#include <graze/contact.hpp>
#include <span>
#include <vector>

#include "arithmetic/arithmetic.hpp"
#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Finds which used vertices of a surface are inside a solid. An edge that does not touch the solid's surface
/// has both ends on one side. So vertices that such edges join are decided together, by one of them.
class VerticesInSolid {
 public:
  /// Finds them anew. `touching` lists all edges of `surface` that touch the solid's surface, in any order
  /// and several times, and may list others. Both surfaces have been refitted for faces.
  void find(const Surface& surface, const Surface& solid, std::span<const std::uint32_t> touching,
            DecisionCount& count);
  /// Takes all used vertices of the surface to be inside, or none.
  void set_all(const Surface& surface);
  void set_none(const Surface& surface);

  /// The vertices inside. Those that follow each other are mostly beside each other, as leaves have them.
  [[nodiscard]] std::span<const std::uint32_t> inside() const { return inside_; }
  /// The side of the solid on which a vertex is: `back` inside, `none` on the surface.
  [[nodiscard]] Side side_of(std::uint32_t vertex) const {
    if (states_[vertex] == State::on_surface) return Side::none;
    return states_[vertex] == State::inside ? Side::back : Side::front;
  }
  [[nodiscard]] bool has_some() const { return !inside_.empty(); }
  /// Whether some are inside a part of the solid that is wound inside out. `find` sees that.
  [[nodiscard]] bool has_inside_out() const { return has_inside_out_; }
  [[nodiscard]] bool has_all(const Surface& surface) const {
    return inside_.size() == surface.mesh().regions().vertices().size();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.states_, self.beside_, self.touching_, self.candidates_, self.joined_, self.inside_);
  }
  void reserve(const PairRoom& room);

 private:
  /// A vertex outside the solid's box is `outside`.
  enum class State : std::uint8_t { outside, candidate, joined, inside, on_surface };

  void begin(const Surface& surface);
  void list_candidates(const Surface& surface, const Box& box);
  void list_touching(const IndexedMesh& mesh, std::span<const std::uint32_t> touching);
  [[nodiscard]] bool join(const IndexedMesh& mesh, std::uint32_t first);
  [[nodiscard]] bool is_joined(std::uint32_t vertex, std::uint32_t other) const;

  std::vector<State> states_;         ///< by vertex. All are `outside` between two pairs
  std::vector<std::uint8_t> beside_;  ///< by vertex: whether an edge of it touches. All are 0 between pairs
  std::vector<std::uint64_t> touching_;    ///< the edges that touch, by their ends, ascending
  std::vector<std::uint32_t> candidates_;  ///< the vertices in the solid's box
  std::vector<std::uint32_t> joined_;      ///< those that are decided together
  std::vector<std::uint32_t> inside_;
  bool has_inside_out_ = false;
};

}  // namespace graze
