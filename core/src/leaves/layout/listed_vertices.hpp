#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"
#include "leaves/layout/filter_frame.hpp"

namespace graze {

/// Listed vertices of a surface in a frame. Of those too large for the kernels the coordinates are left out,
/// and the size says so.
void to_frame(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
              kernels::Point* converted);

/// Vertices of a surface in a frame, each converted when it is asked for.
class VerticesInFrame {
 public:
  void begin(const Surface& surface, const FilterFrame& frame) {
    surface_ = &surface;
    frame_ = frame;
    make_room(surface.mesh().vertex_count());
    if (++now_ == 0) {
      std::fill(converted_in_.begin(), converted_in_.end(), 0U);
      now_ = 1;
    }
  }
  const kernels::Point& operator[](std::uint32_t vertex) {
    if (std::exchange(converted_in_[vertex], now_) != now_)
      to_frame(*surface_, std::span(&vertex, 1), frame_, &points_[vertex]);
    return points_[vertex];
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.points_, self.converted_in_);
  }
  void reserve_as(const VerticesInFrame& other) { make_room(other.points_.size()); }
  void reserve(const PairRoom& room) { make_room(room.vertices); }

 private:
  void make_room(std::size_t vertices) {
    if (points_.size() >= vertices) return;
    points_.resize(vertices);
    converted_in_.resize(vertices);
  }

  const Surface* surface_ = nullptr;
  FilterFrame frame_;
  std::vector<kernels::Point> points_;
  std::vector<std::uint32_t> converted_in_;  ///< in which round each was
  std::uint32_t now_ = 0;
};

}  // namespace graze
