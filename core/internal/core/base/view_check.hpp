#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/position_view.hpp>
#include <optional>
#include <string>

namespace graze {

/// Why a view cannot be the positions of a mesh.
struct ViewProblem {
  enum class Kind : std::uint8_t { wrong_count, null_memory, misaligned_memory };
  Kind kind = Kind::wrong_count;
  std::string got;  ///< what the mesh got, for a message
};

/// Says why a view cannot be the positions of a mesh of so many vertices, or nothing if it can. The
/// coordinates are not looked at.
inline std::optional<ViewProblem> problem_of_view(const PositionView& view, std::size_t vertex_count) {
  if (view.size() != vertex_count)
    return ViewProblem{ViewProblem::Kind::wrong_count, std::to_string(view.size()) + " positions for " +
                                                           std::to_string(vertex_count) + " vertices"};
  if (view.data() == nullptr) return ViewProblem{ViewProblem::Kind::null_memory, "null memory"};
  const std::size_t alignment = view.is_double() ? alignof(double) : alignof(float);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the address is looked at, not used
  if (reinterpret_cast<std::uintptr_t>(view.data()) % alignment != 0 ||
      view.stride_bytes() % alignment != 0 || view.coordinate_stride_bytes() % alignment != 0)
    return ViewProblem{ViewProblem::Kind::misaligned_memory, "memory that is not aligned to its numbers"};
  return std::nullopt;
}

}  // namespace graze
