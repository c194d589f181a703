#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "accuracy/scenes.hpp"
#include "accuracy/tally.hpp"
#include "core/pair/pair_counters.hpp"

namespace graze::tools {

/// The code that finds and measures a contact. The last three are those of `closest`, whose closest points
/// fill a stretch or an area. `vertex_set` is the detail `vertices`. All others are found by `features`.
enum class Kernel : std::uint8_t {
  vertex_vertex,
  vertex_edge,
  vertex_triangle,
  vertex_flat_quad,
  vertex_warped_quad,
  edge_edge,
  edge_through_face,
  fold,
  vertex_set,
  parallel_edges,
  edge_along_face,
  parallel_faces
};
inline constexpr std::size_t kernel_count = 12;

std::string_view name_of(Kernel kernel);

/// The contract's bound on a distance, in the unit of `KernelErrors::distance`.
inline constexpr double distance_bound = 32;

/// The errors of one kernel on one kind of input. A unit is 2^-53 of the size of the two features plus their
/// gap. A point's unit counts its largest coordinate too.
struct KernelErrors {
  std::uint64_t contacts = 0;
  std::uint64_t wrong_names = 0;  ///< reported and not true, or true and not reported
  ErrorTally distance;            ///< in units
  ErrorTally distance_absolute;
  ErrorTally distance_relative;  ///< of those above 0
  ErrorTally point;              ///< either point from the true one, in its unit
  ErrorTally apart;         ///< the distance of the reported points from the true distance, in a point's unit
  ErrorTally normal_angle;  ///< from the true direction, in radians, where that follows from the positions
  ErrorTally normal_length;  ///< from 1
};

/// All kernels on one kind of input.
struct KernelStudy {
  std::uint64_t scenes = 0;
  std::array<KernelErrors, kernel_count> kernels;
  std::uint64_t pair_rows = 0;
  std::uint64_t wrong_pair_rows = 0;  ///< bounds that are not the true distance rounded down and up
  PairCounters counters;

  /// Finds the contacts of a scene with the library, in every detail, and with exact arithmetic, and
  /// compares.
  void add(const KernelScene& scene);

  [[nodiscard]] KernelErrors& of(Kernel kernel) { return kernels[static_cast<std::size_t>(kernel)]; }
  [[nodiscard]] const KernelErrors& of(Kernel kernel) const {
    return kernels[static_cast<std::size_t>(kernel)];
  }
};

}  // namespace graze::tools
