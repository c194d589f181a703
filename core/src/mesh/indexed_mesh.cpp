#include "core/mesh/indexed_mesh.hpp"

#include <algorithm>
#include <graze/error.hpp>
#include <string>

#include "base/limits.hpp"
#include "core/base/block_sizes.hpp"
#include "core/base/bytes_of.hpp"
#include "core/base/floating_point_scope.hpp"
#include "mesh/block_order.hpp"
#include "mesh/creases.hpp"
#include "mesh/vertex_fans.hpp"

namespace graze {
namespace {

/// Fills rows of values: `visit` calls what it is given with each row and value, in the same order twice. The
/// values of a row come in the order in which they were visited.
template <typename Visit>
void fill_rows(std::size_t row_count, std::vector<std::uint32_t>& values, std::vector<std::uint32_t>& begin,
               const Visit& visit) {
  // While rows are filled, each begins one index further on, where the row before ends.
  begin.assign(row_count + 2, 0);
  visit([&](std::uint32_t row, std::uint32_t) { ++begin[row + 2]; });
  for (std::size_t row = 0; row < row_count; ++row) begin[row + 2] += begin[row + 1];
  values.resize(begin[row_count + 1]);
  visit([&](std::uint32_t row, std::uint32_t value) { values[begin[row + 1]++] = value; });
  begin.pop_back();
}

/// Calls `add` with each value of a list of three or four that is not there before.
template <typename Add>
void for_each_once(std::span<const std::uint32_t> list, const Add& add) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) ==
        list.begin() + static_cast<std::ptrdiff_t>(i))
      add(list[i]);
}

/// A corner as the caller sees it: one that may have been negative both ways.
std::string corner_text(std::uint32_t corner) {
  const std::string text = std::to_string(corner);
  const auto with_sign = static_cast<std::int32_t>(corner);
  return with_sign < 0 ? text + " (" + std::to_string(with_sign) + " with a sign)" : text;
}

std::vector<Eigen::Vector3d> copy_of(const PositionView& view) {
  if (view.data() == nullptr && view.size() > 0) throw Error("mesh: the rest positions are null memory");
  if (view.size() >= IndexedMesh::no_edge)
    throw Error("mesh: " + std::to_string(view.size()) + " vertices are more than 32-bit numbers name");
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(view.size());
  for (std::size_t i = 0; i < view.size(); ++i) positions.push_back(view[i]);
  return positions;
}

}  // namespace

IndexedMesh::IndexedMesh(PositionView rest, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> corner_counts) {
  const FloatingPointScope scope;
  rest_ = copy_of(rest);
  take_faces(corners, corner_counts);
  check_faces();
  find_unused();
  check_rest();
  number_edges();
  regions_ = RegionTree(*this);
  long_regions_ = LongRegions(*this);
}

void IndexedMesh::take_faces(std::span<const std::uint32_t> corners,
                             std::span<const std::uint32_t> corner_counts) {
  std::uint64_t corner = 0;
  bool is_even = true;
  for (std::size_t face = 0; face < corner_counts.size(); ++face) {
    if (corner_counts[face] != 3 && corner_counts[face] != 4)
      throw Error("mesh: face " + std::to_string(face) + " has " + std::to_string(corner_counts[face]) +
                  " corners; a face is a triangle or a quad");
    is_even = is_even && corner_counts[face] == corner_counts.front();
    corner += corner_counts[face];
    if (corner > corners.size()) break;
  }
  if (corner != corners.size())
    throw Error("mesh: the faces' corner counts add up to " +
                std::string(corner > corners.size() ? "more than " : "") +
                std::to_string(std::min<std::uint64_t>(corner, corners.size())) + ", but " +
                std::to_string(corners.size()) + " corners were given");
  if (corner_counts.empty()) throw Error("mesh: it has no face, so it has no surface");
  if (corners.size() >= no_edge) throw Error("mesh: its faces have more corners than 32-bit numbers count");
  corners_.assign(corners.begin(), corners.end());
  face_count_ = static_cast<std::uint32_t>(corner_counts.size());
  corners_each_ = corner_counts.front();
  if (is_even) return;
  face_begin_.reserve(corner_counts.size() + 1);
  face_begin_.push_back(0);
  for (const std::uint32_t count : corner_counts) face_begin_.push_back(face_begin_.back() + count);
}

void IndexedMesh::check_faces() const {
  for (std::uint32_t index = 0; index < face_count(); ++index)
    for (const std::uint32_t corner : face(index))
      if (corner >= vertex_count())
        throw Error("mesh: face " + std::to_string(index) + " names vertex " + corner_text(corner) +
                    ", but there are " + std::to_string(vertex_count()) + " vertices");
}

void IndexedMesh::check_rest() const {
  for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex)
    if (is_used(vertex) && !is_within_limits(rest_[vertex]))
      throw Error("mesh: the rest position of vertex " + std::to_string(vertex) +
                  " is not finite or has a coordinate beyond 2^120");
}

void IndexedMesh::find_unused() {
  used_.assign(vertex_count(), 0);
  for (const std::uint32_t corner : corners_) used_[corner] = 1;
  if (std::find(used_.begin(), used_.end(), 0) == used_.end()) std::vector<std::uint8_t>().swap(used_);
}

namespace {

/// Finds the corner where each edge is first met. All corners that begin edges with the same two vertices get
/// the first of them. `ends` holds the lower end's corners with their higher ends.
void join_equal(std::span<std::uint64_t> ends, std::vector<std::uint32_t>& first_met) {
  // Higher end, then corner: equal ones follow one another, the first met before the others.
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0, first = 0; i < ends.size(); ++i) {
    if (ends[i] >> 32 != ends[first] >> 32) first = i;
    first_met[static_cast<std::uint32_t>(ends[i])] = static_cast<std::uint32_t>(ends[first]);
  }
}

}  // namespace

/// Corners are put in rows by the lower end of the edge that they begin. Those of a row that begin one edge
/// are joined. Then edges are numbered by their first corners.
void IndexedMesh::number_edges() {
  const auto visit = [&](const auto& add) {
    std::uint32_t corner = 0;
    for (std::uint32_t index = 0; index < face_count(); ++index) {
      const auto ring = face(index);
      for (std::size_t i = 0; i < ring.size(); ++i, ++corner) {
        const auto [low, high] = std::minmax(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
        add(corner, low, high);
      }
    }
  };
  face_edges_.assign(corners_.size(), no_edge);
  std::vector<std::uint32_t> begin(std::size_t{vertex_count()} + 2, 0);
  visit([&](std::uint32_t, std::uint32_t low, std::uint32_t high) {
    if (low != high) ++begin[low + 2];
  });
  for (std::size_t row = 0; row < vertex_count(); ++row) begin[row + 2] += begin[row + 1];
  std::vector<std::uint64_t> ends(begin[vertex_count() + std::size_t{1}]);
  visit([&](std::uint32_t corner, std::uint32_t low, std::uint32_t high) {
    if (low != high) ends[begin[low + 1]++] = std::uint64_t{high} << 32 | corner;
  });
  for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex)
    join_equal(std::span(ends).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]), face_edges_);
  std::uint32_t count = 0;
  visit([&](std::uint32_t corner, std::uint32_t, std::uint32_t) {
    if (face_edges_[corner] == corner) ++count;
  });
  edges_.reserve(count);
  visit([&](std::uint32_t corner, std::uint32_t low, std::uint32_t high) {
    if (low == high) return;
    const std::uint32_t first = face_edges_[corner];
    face_edges_[corner] = first == corner ? edge_count() : face_edges_[first];
    if (first == corner) edges_.push_back({low, high});
  });
}

const IndexedMesh::Rows& IndexedMesh::neighbours() const {
  return neighbours_.get([this] {
    Rows rows;
    fill_rows(vertex_count(), rows.values, rows.begin, [&](const auto& add) {
      for (const auto& [low, high] : edges_) {
        add(low, high);
        add(high, low);
      }
    });
    for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex) {
      const auto row =
          std::span(rows.values).subspan(rows.begin[vertex], rows.begin[vertex + 1] - rows.begin[vertex]);
      std::sort(row.begin(), row.end());
    }
    return rows;
  });
}

const IndexedMesh::Rows& IndexedMesh::faces_of_vertices() const {
  return vertex_faces_.get([this] {
    Rows rows;
    fill_rows(vertex_count(), rows.values, rows.begin, [&](const auto& add) {
      for (std::uint32_t index = 0; index < face_count(); ++index)
        for_each_once(face(index), [&](std::uint32_t vertex) { add(vertex, index); });
    });
    return rows;
  });
}

const IndexedMesh::Rows& IndexedMesh::faces_of_edges() const {
  return edge_faces_.get([this] {
    Rows rows;
    fill_rows(edge_count(), rows.values, rows.begin, [&](const auto& add) {
      for (std::uint32_t index = 0; index < face_count(); ++index)
        for_each_once(face_edges(index), [&](std::uint32_t edge) {
          if (edge != no_edge) add(edge, index);
        });
    });
    return rows;
  });
}

namespace {

/// The corner of a triangle that is not an end of an edge, if the others are its ends.
std::optional<std::uint32_t> corner_across(const std::array<std::uint32_t, 3>& triangle,
                                           const std::array<std::uint32_t, 2>& ends) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(triangle[(i + 1) % 3], triangle[(i + 2) % 3]);
    if (low == ends[0] && high == ends[1] && triangle[i] != low && triangle[i] != high) return triangle[i];
  }
  return std::nullopt;
}

}  // namespace

const IndexedMesh::Rows& IndexedMesh::corners_across_edges() const {
  return edge_across_.get([this] {
    Rows rows;
    fill_rows(edge_count(), rows.values, rows.begin, [&](const auto& add) {
      for (std::uint32_t index = 0; index < face_count(); ++index)
        for_each_once(face_edges(index), [&](std::uint32_t edge) {
          const auto corner = face(index);
          for (std::size_t last = 2; edge != no_edge && last < corner.size(); ++last)
            if (const auto across = corner_across({corner[0], corner[last - 1], corner[last]}, edges_[edge]))
              add(edge, *across);
        });
    });
    return rows;
  });
}

const IndexedMesh::Rows& IndexedMesh::fans() const {
  return fans_.get([this] {
    Rows rows;
    list_fans(*this, rows.values, rows.begin);
    rows.values.shrink_to_fit();
    return rows;
  });
}

const IndexedMesh::Creases& IndexedMesh::creases() const {
  return creases_.get([this] {
    const FloatingPointScope scope;
    return Creases{find_creases(*this)};
  });
}

const IndexedMesh::Blocks& IndexedMesh::blocks() const {
  return blocks_.get([this] {
    const FloatingPointScope scope;
    Blocks blocks;
    blocks.order = block_order_of(*this);
    if (has_stretches())
      list_stretch_groups(blocks.order, blocks.stretch_groups.values, blocks.stretch_groups.begin);
    blocks.stretch_groups.values.shrink_to_fit();
    return blocks;
  });
}

bool IndexedMesh::has_stretches() const {
  return uses_all_vertices() && vertex_count() > most_without_stretches;
}

void IndexedMesh::prepare_for(Use use) const {
  if (use == Use::blocks) static_cast<void>(blocks());
  if (use == Use::normals_of_points || use == Use::normals) {
    static_cast<void>(fans());
    static_cast<void>(faces_of_vertices());
  }
  if (use == Use::normals || use == Use::faces_of_edges) static_cast<void>(faces_of_edges());
  if (use == Use::sides_of_edges) {
    static_cast<void>(corners_across_edges());
    static_cast<void>(creases());
  }
  if (use == Use::neighbours) static_cast<void>(neighbours());
  if (use == Use::poses) static_cast<void>(rest_reach());
}

const RestReach& IndexedMesh::rest_reach() const {
  return rest_reach_.get([this] {
    const FloatingPointScope scope;
    return RestReach(*this);
  });
}

std::size_t IndexedMesh::byte_count() const {
  const auto bytes_made = [](const auto&... lists) {
    return ((lists.if_made() != nullptr ? lists.if_made()->byte_count() : 0) + ...);
  };
  return sizeof(IndexedMesh) + bytes_of(rest_) + bytes_of(corners_) + bytes_of(face_begin_) +
         bytes_of(face_edges_) + bytes_of(edges_) + bytes_of(used_) + regions_.byte_count() +
         long_regions_.byte_count() +
         bytes_made(neighbours_, vertex_faces_, edge_faces_, edge_across_, fans_, creases_, blocks_,
                    rest_reach_);
}

}  // namespace graze
