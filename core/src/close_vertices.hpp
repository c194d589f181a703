#pragma once

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "contact_name.hpp"
#include "leaf_features.hpp"
#include "listed_vertices.hpp"
#include "local_vertices.hpp"
#include "vertex_rows.hpp"
#include "working_memory.hpp"

namespace graze {

/// Vertices of a leaf, and of the leaves beside it.
struct CloseVerticesScratch {
  /// So many of those beside a leaf are compared at once, or those of one leaf.
  static constexpr std::size_t most_beside = 512;

  std::vector<std::uint32_t> found_a;  ///< longer than they are many
  std::vector<std::uint32_t> found_b;
  LocalVertices a;
  LocalVertices b;
  VertexRowsScratch rows;  ///< of a

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.found_a, self.found_b, self.a, self.b, self.rows);
  }
  void make_room(std::size_t of_leaf, std::size_t beside);
  void reserve(const PairRoom& room);
};

/// Finds the pairs of vertices of leaves that are strictly closer than a limit: those of a leaf of a with
/// those of all leaves of b that are given beside it one after the other, at once.
class CloseVertices {
 public:
  /// Names are appended to `names`; all are there after `finish`.
  CloseVertices(const SurfacePair& pair, double limit, CloseVerticesScratch& scratch,
                std::vector<ContactName>& names)
      : pair_(pair), limit_(limit), scratch_(scratch), names_(names) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  void finish();

 private:
  void begin(const LeafOf& leaf);
  void compare();

  const SurfacePair& pair_;
  double limit_;
  CloseVerticesScratch& scratch_;
  std::vector<ContactName>& names_;
  const Region* leaf_ = nullptr;  ///< of a
  Box box_;                       ///< of the leaf and of what it is asked about
  std::optional<InsideBox> inside_;
  std::size_t found_ = 0;  ///< of b, in what is reached
};

}  // namespace graze
