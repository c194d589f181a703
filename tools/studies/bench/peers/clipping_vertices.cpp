#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/peers/exact_distance.hpp"
#include "bench/peers/near_objects.hpp"
#include "bench/peers/peers.hpp"
#include "bench/peers/simd.hpp"

namespace graze::bench {
namespace {

/// Puts the points of a list into buckets along one axis, so that those within some reach of a coordinate
/// stand in one stretch.
class Buckets {
 public:
  void sort(PointList& list, const FloatBox& box, float width) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (box.max[i] - box.min[i] > box.max[axis] - box.min[axis]) axis = i;
    axis_ = axis;
    first_ = box.min[axis];
    constexpr float most = 1024;
    width_ = std::max(width, (box.max[axis] - first_) / most);
    const auto count = static_cast<std::size_t>((box.max[axis] - first_) / width_) + 1;
    begin_.assign(count + 1, 0);
    const float* values = axis_values(list);
    bucket_.resize(list.count);
    for (std::size_t i = 0; i < list.count; ++i) ++begin_[(bucket_[i] = bucket_of(values[i])) + 1];
    for (std::size_t i = 0; i < count; ++i) begin_[i + 1] += begin_[i];
    sorted_.clear();
    sorted_.make_room(list.count);
    next_.assign(begin_.begin(), begin_.end());
    for (std::size_t i = 0; i < list.count; ++i) {
      const std::size_t place = next_[bucket_[i]]++;
      sorted_.x[place] = list.x[i];
      sorted_.y[place] = list.y[i];
      sorted_.z[place] = list.z[i];
      sorted_.index[place] = list.index[i];
    }
    sorted_.count = list.count;
    std::swap(sorted_, list);
  }

  [[nodiscard]] const float* axis_values(const PointList& list) const {
    return axis_ == 0 ? list.x.data() : axis_ == 1 ? list.y.data() : list.z.data();
  }
  /// The places of the sorted points that may be within `reach` of `value`.
  [[nodiscard]] std::pair<std::size_t, std::size_t> range(float value, float reach) const {
    return {begin_[bucket_of(value - reach)], begin_[bucket_of(value + reach) + 1]};
  }

 private:
  [[nodiscard]] std::uint32_t bucket_of(float value) const {
    const float place = std::max((value - first_) / width_, 0.0F);
    return std::min(static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(begin_.size()) - 2);
  }

  int axis_ = 0;
  float first_ = 0, width_ = 1;
  std::vector<std::uint32_t> begin_, next_, bucket_;
  PointList sorted_;
};

/// One thread's working memory and what it found.
struct Clipper {
  PointList a, b;
  Buckets buckets;
  std::vector<std::uint32_t> places;
  std::vector<VertexPair> found;
};

/// Boxes of objects, near pairs of objects, the vertices of each in the other's box until that shrinks no
/// more, and then all pairs of what is left, along the longest axis where that is much.
class ClippingVertices final : public Contender {
 public:
  ClippingVertices(const World& world, unsigned threads)
      : world_(world), workers_(threads), near_(world, workers_), clippers_(workers_.slots()) {}

  void frame() override {
    near_.update();
    for (Clipper& clipper : clippers_) clipper.found.clear();
    workers_.each(near_.pairs().size(), [&](std::size_t i, std::size_t slot) {
      const ObjectPair& pair = near_.pairs()[i];
      Clipper& clipper = clippers_[slot];
      if (clip(pair, clipper)) match(pair, clipper);
    });
  }

  void collect(Found& found) const override {
    for (const Clipper& clipper : clippers_)
      found.vertex_pairs.insert(found.vertex_pairs.end(), clipper.found.begin(), clipper.found.end());
  }

 private:
  /// Whether anything is left of both.
  bool clip(const ObjectPair& pair, Clipper& clipper) const {
    PointList& a = clipper.a;
    PointList& b = clipper.b;
    const double reach = world_.distance;
    const FloatBox region = common(grown(near_.box(pair.a), reach), grown(near_.box(pair.b), reach));
    if (!take(pair.a, region, a)) return false;
    if (!take(pair.b, common(region, grown(a.box(), reach)), b)) return false;
    constexpr int most_passes = 4;
    for (int pass = 0; pass < most_passes; ++pass) {
      const std::size_t before = a.count + b.count;
      keep_inside(grown(b.box(), reach), a);
      if (a.count == 0) return false;
      keep_inside(grown(a.box(), reach), b);
      if (b.count == 0) return false;
      if (10 * (a.count + b.count) > 9 * before) break;
    }
    return true;
  }

  bool take(std::uint32_t object, const FloatBox& region, PointList& list) const {
    list.clear();
    add_inside(world_.positions_of(object), 0, world_.objects[object].vertex_count, region, list);
    return list.count > 0;
  }

  void match(const ObjectPair& pair, Clipper& clipper) const {
    constexpr std::size_t few_enough = 2048;
    const PointList& a = clipper.a;
    PointList& b = clipper.b;
    const bool is_sorted = a.count * b.count > few_enough;
    if (is_sorted) clipper.buckets.sort(b, b.box(), static_cast<float>(world_.distance));
    const float* along = is_sorted ? clipper.buckets.axis_values(a) : nullptr;
    const auto reach = static_cast<float>(world_.distance * (1 + 1e-5));
    const float limit = square_above(world_.distance);
    clipper.places.resize(std::max(clipper.places.size(), b.count + 8));
    for (std::size_t i = 0; i < a.count; ++i) {
      const auto [begin, end] =
          is_sorted ? clipper.buckets.range(along[i], reach) : std::pair(std::size_t{0}, b.count);
      std::uint32_t* const first = clipper.places.data();
      const std::uint32_t* const last = add_near(b, begin, end, a.x[i], a.y[i], a.z[i], limit, first);
      for (const std::uint32_t* place = first; place != last; ++place)
        add_if_near(pair, a.index[i], b.index[*place], clipper.found);
    }
  }

  void add_if_near(const ObjectPair& pair, std::uint32_t a, std::uint32_t b,
                   std::vector<VertexPair>& found) const {
    const float* p = world_.positions_of(pair.a) + 3 * std::size_t{a};
    const float* q = world_.positions_of(pair.b) + 3 * std::size_t{b};
    if (is_nearer(p, q, world_.distance)) found.push_back({pair.a, pair.b, a, b});
  }

  const World& world_;
  Workers workers_;
  NearObjects near_;
  std::vector<Clipper> clippers_;
};

}  // namespace

std::unique_ptr<Contender> make_clipping_vertices(const World& world, unsigned threads) {
  return std::make_unique<ClippingVertices>(world, threads);
}

}  // namespace graze::bench
