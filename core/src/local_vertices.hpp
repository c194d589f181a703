#pragma once

#include <graze/box.hpp>
#include <graze/surface.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "filter_frame.hpp"
#include "kernels/filter.hpp"

namespace graze {

/// Vertices of one surface in a frame, in rows of x, y and z.
class LocalVertices {
 public:
  /// Takes the listed vertices, and gives their box.
  Box take(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame);
  /// Takes some of another's, in that order; behind the places there are as many more as the padding says.
  static constexpr std::size_t padding = 3;
  void take(const LocalVertices& all, std::span<const std::uint32_t> places);

  [[nodiscard]] std::size_t count() const { return vertices_.size(); }
  [[nodiscard]] std::uint32_t vertex(std::size_t i) const { return vertices_[i]; }
  [[nodiscard]] std::span<const float> coordinates(std::size_t axis) const {
    return {data_.data() + axis * stride_, count()};
  }
  [[nodiscard]] kernels::Block block() const { return {data_.data(), stride_, count()}; }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.data_, self.vertices_);
  }
  void reserve(std::size_t most);

 private:
  void begin(std::size_t count);
  /// Kernels may read as many more as they have lanes, from any place on.
  static std::size_t stride_of(std::size_t count) { return count + kernels::lanes; }

  std::vector<float> data_;
  std::size_t stride_ = 0;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace graze
