#pragma once

#include <tuple>
#include <vector>

#include "contact_name.hpp"
#include "dmv.hpp"
#include "local_vertices.hpp"
#include "vertex_rows.hpp"
#include "working_memory.hpp"

namespace graze {

struct VertexSweepScratch {
  std::vector<std::uint32_t> found;    ///< vertices in a box; longer than they are many
  std::vector<std::uint32_t> regions;  ///< to be gone through
  LocalVertices a;
  LocalVertices b;
  LocalVertices sorted;              ///< those of b by their slabs
  std::vector<std::uint32_t> slab;   ///< of each vertex of b
  std::vector<std::uint32_t> begin;  ///< of the slabs
  VertexRowsScratch rows;            ///< of a

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.found, self.regions, self.a, self.b, self.sorted, self.slab, self.begin, self.rows);
  }
  void reserve(const PairRoom& room);
};

/// What came of a sweep.
enum class Swept : std::uint8_t {
  all,            ///< all pairs were found
  too_many,       ///< nothing was, since too many vertices are near the other surface
  out_of_budget,  ///< nothing was
};

/// Names, in place of what `names` held, all pairs of vertices of two surfaces that are nearer than `limit`,
/// where few of either are near the other: those in the other's box are taken, and those of them in slabs
/// beside each other are compared. Less work than to walk down two trees where surfaces meet in one place;
/// where they lie along each other it gives up before it costs much.
Swept sweep_close_vertices(const SurfacePair& pair, double limit, VertexSweepScratch& scratch,
                           WorkMeter& meter, std::vector<ContactName>& names);

}  // namespace graze
