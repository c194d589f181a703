#include <algorithm>
#include <bit>
#include <cmath>

#include "bench/peers/exact_distance.hpp"
#include "bench/peers/peers.hpp"
#include "bench/peers/workers.hpp"

namespace graze::bench {
namespace {

struct Point {
  float x;
  std::uint32_t row;     ///< its row's hash
  std::uint32_t number;  ///< among all vertices of all objects
};

/// All vertices of all objects in rows along x as wide as the distance, sorted within each row. Every row is
/// swept against itself and the four that come after it. Rows are kept in a table by hash. Strangers that
/// share a place cost time and are told apart by their coordinates.
class RowGrid final : public Contender {
 public:
  RowGrid(const World& world, unsigned threads)
      : world_(world), width_(world.distance * (1 + 1e-9)), workers_(threads), found_(workers_.slots()) {
    for (std::uint32_t i = 0; i < world.objects.size(); ++i)
      object_of_.insert(object_of_.end(), world.objects[i].vertex_count, i);
    points_.resize(object_of_.size());
    sorted_.resize(object_of_.size());
    rows_ = std::bit_ceil(object_of_.size());
    begin_.resize(rows_ + 1);
  }

  void frame() override {
    for (std::vector<VertexPair>& found : found_) found.clear();
    sort_into_rows();
    constexpr std::size_t block = 256;
    workers_.each((rows_ + block - 1) / block, [&](std::size_t k, std::size_t slot) {
      for (std::size_t row = k * block; row < std::min(rows_, (k + 1) * block); ++row)
        if (begin_[row] < begin_[row + 1]) sweep(row, found_[slot]);
    });
  }

  void collect(Found& found) const override {
    for (const std::vector<VertexPair>& part : found_)
      found.vertex_pairs.insert(found.vertex_pairs.end(), part.begin(), part.end());
  }

 private:
  [[nodiscard]] std::int64_t cell(float value) const {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(value) / width_));
  }
  [[nodiscard]] std::uint32_t row_of(std::int64_t y, std::int64_t z) const {
    const std::uint64_t mixed = static_cast<std::uint64_t>(y) * 0x9e3779b97f4a7c15U ^
                                static_cast<std::uint64_t>(z) * 0xc2b2ae3d27d4eb4fU;
    return static_cast<std::uint32_t>((mixed ^ mixed >> 29U) & (rows_ - 1));
  }

  void sort_into_rows() {
    const float* all = world_.positions.data();
    std::fill(begin_.begin(), begin_.end(), 0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::uint32_t row = row_of(cell(all[3 * i + 1]), cell(all[3 * i + 2]));
      points_[i] = {all[3 * i], row, static_cast<std::uint32_t>(i)};
      ++begin_[row + 1];
    }
    for (std::size_t i = 0; i < rows_; ++i) begin_[i + 1] += begin_[i];
    next_.assign(begin_.begin(), begin_.end() - 1);
    for (const Point& point : points_) sorted_[next_[point.row]++] = point;
    constexpr std::size_t block = 256;
    workers_.each((rows_ + block - 1) / block, [&](std::size_t k, std::size_t) {
      for (std::size_t row = k * block; row < std::min(rows_, (k + 1) * block); ++row)
        std::sort(sorted_.begin() + begin_[row], sorted_.begin() + begin_[row + 1],
                  [](const Point& a, const Point& b) { return a.x < b.x; });
    });
  }

  /// Several rows of the grid may share this place of the table: each point is looked at with its own
  /// neighbours.
  void sweep(std::size_t row, std::vector<VertexPair>& found) const {
    for (std::size_t i = begin_[row]; i < begin_[row + 1]; ++i) {
      const Point& point = sorted_[i];
      const float* p = world_.positions.data() + 3 * std::size_t{point.number};
      sweep_row(point, row, i + 1, found);
      const std::int64_t y = cell(p[1]);
      const std::int64_t z = cell(p[2]);
      constexpr std::int64_t later[4][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
      for (const auto& [dy, dz] : later) {
        const std::uint32_t other = row_of(y + dy, z + dz);
        if (other == row) continue;
        const auto first =
            std::lower_bound(sorted_.begin() + begin_[other], sorted_.begin() + begin_[other + 1],
                             static_cast<double>(point.x) - world_.distance,
                             [](const Point& q, double x) { return static_cast<double>(q.x) < x; });
        sweep_row(point, other, static_cast<std::size_t>(first - sorted_.begin()), found, y + dy, z + dz);
      }
    }
  }

  /// The rest of the point's own place in the table: whatever it holds.
  void sweep_row(const Point& point, std::size_t row, std::size_t from,
                 std::vector<VertexPair>& found) const {
    for (std::size_t i = from; i < begin_[row + 1]; ++i) {
      if (static_cast<double>(sorted_[i].x) - static_cast<double>(point.x) > world_.distance) return;
      test(point.number, sorted_[i].number, found);
    }
  }
  /// Another place of the table: only what is in the row that was meant.
  void sweep_row(const Point& point, std::size_t row, std::size_t from, std::vector<VertexPair>& found,
                 std::int64_t y, std::int64_t z) const {
    for (std::size_t i = from; i < begin_[row + 1]; ++i) {
      if (static_cast<double>(sorted_[i].x) - static_cast<double>(point.x) > world_.distance) return;
      const float* q = world_.positions.data() + 3 * std::size_t{sorted_[i].number};
      if (cell(q[1]) == y && cell(q[2]) == z) test(point.number, sorted_[i].number, found);
    }
  }

  void test(std::uint32_t first, std::uint32_t second, std::vector<VertexPair>& found) const {
    const std::uint32_t a = std::min(first, second);
    const std::uint32_t b = std::max(first, second);
    if (object_of_[a] == object_of_[b]) return;
    const float* all = world_.positions.data();
    if (!is_nearer(all + 3 * std::size_t{a}, all + 3 * std::size_t{b}, world_.distance)) return;
    const auto vertex = [&](std::uint32_t number) {
      return number - static_cast<std::uint32_t>(world_.objects[object_of_[number]].first_vertex);
    };
    found.push_back({object_of_[a], object_of_[b], vertex(a), vertex(b)});
  }

  const World& world_;
  double width_;  ///< of a row
  Workers workers_;
  std::vector<std::uint32_t> object_of_;  ///< of each vertex
  std::size_t rows_ = 0;                  ///< places in the table, a power of two
  std::vector<Point> points_, sorted_;
  std::vector<std::uint32_t> begin_, next_;
  std::vector<std::vector<VertexPair>> found_;
};

}  // namespace

std::unique_ptr<Contender> make_row_grid(const World& world, Task, unsigned threads) {
  return std::make_unique<RowGrid>(world, threads);
}

}  // namespace graze::bench
