#include <algorithm>
#include <utility>

#include "bench/peers/near_objects.hpp"
#include "bench/peers/peers.hpp"
#include "bench/peers/triangle_boxes.hpp"

namespace graze::bench {
namespace {

/// One thread's working memory and what it found.
struct Clipper {
  BoxList a, b, sorted;
  std::vector<std::pair<float, std::uint32_t>> order;
  std::vector<std::uint32_t> places;
  std::vector<TrianglePair> found;
};

/// The treatment of two triangles whose boxes are near.
enum class Ending : std::uint8_t { measured, listed };

/// As ClippingVertices, with the boxes of triangles.
class ClippingTriangles final : public Contender {
 public:
  ClippingTriangles(const World& world, unsigned threads, Ending ending)
      : world_(world),
        ending_(ending),
        workers_(threads),
        near_(world, workers_),
        boxes_(world.objects.size()),
        versions_(world.objects.size()),
        clippers_(workers_.slots()) {}

  void frame() override {
    near_.update();
    workers_.each(near_.objects().size(), [&](std::size_t i, std::size_t) {
      const std::uint32_t object = near_.objects()[i];
      if (versions_[object] == world_.versions[object]) return;
      versions_[object] = world_.versions[object];
      make_boxes(world_, object, boxes_[object]);
    });
    for (Clipper& clipper : clippers_) clipper.found.clear();
    workers_.each(near_.pairs().size(), [&](std::size_t i, std::size_t slot) {
      const ObjectPair& pair = near_.pairs()[i];
      if (clip(pair, clippers_[slot])) match(pair, clippers_[slot]);
    });
  }

  void collect(Found& found) const override {
    for (const Clipper& clipper : clippers_)
      found.triangle_pairs.insert(found.triangle_pairs.end(), clipper.found.begin(), clipper.found.end());
  }

 private:
  bool clip(const ObjectPair& pair, Clipper& clipper) const {
    BoxList& a = clipper.a;
    BoxList& b = clipper.b;
    const double reach = world_.distance;
    a.clear();
    add_meeting(boxes_[pair.a], grown(near_.box(pair.b), reach), a);
    if (a.count == 0) return false;
    b.clear();
    add_meeting(boxes_[pair.b], common(grown(near_.box(pair.a), reach), grown(a.box(), reach)), b);
    constexpr int most_passes = 4;
    for (int pass = 0; pass < most_passes && b.count > 0; ++pass) {
      const std::size_t before = a.count + b.count;
      keep_meeting(grown(b.box(), reach), a);
      if (a.count == 0) return false;
      keep_meeting(grown(a.box(), reach), b);
      if (10 * (a.count + b.count) > 9 * before) break;
    }
    return b.count > 0;
  }

  /// Sorts a list along an axis. Returns the longest side of its boxes there.
  static float sort(int axis, Clipper& clipper) {
    BoxList& list = clipper.b;
    const float* values = list.low(axis).data();
    float longest = 0;
    clipper.order.clear();
    for (std::size_t i = 0; i < list.count; ++i) {
      clipper.order.emplace_back(values[i], static_cast<std::uint32_t>(i));
      longest = std::max(longest, list.high(axis)[i] - values[i]);
    }
    std::sort(clipper.order.begin(), clipper.order.end());
    clipper.sorted.clear();
    clipper.sorted.make_room(list.count);
    for (std::size_t i = 0; i < list.count; ++i) {
      const std::uint32_t from = clipper.order[i].second;
      for (std::size_t bound = 0; bound < 6; ++bound)
        clipper.sorted.bounds[bound][i] = list.bounds[bound][from];
      clipper.sorted.index[i] = list.index[from];
    }
    clipper.sorted.count = list.count;
    std::swap(clipper.sorted, list);
    return longest;
  }

  void match(const ObjectPair& pair, Clipper& clipper) const {
    constexpr std::size_t few_enough = 16'384;
    const BoxList& a = clipper.a;
    const FloatBox around = clipper.b.box();
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (around.max[i] - around.min[i] > around.max[axis] - around.min[axis]) axis = i;
    const bool is_sorted = a.count * clipper.b.count > few_enough;
    const float longest = is_sorted ? sort(axis, clipper) : 0;
    const BoxList& b = clipper.b;
    const auto reach = static_cast<float>(world_.distance * (1 + 1e-5));
    const float limit = square_above(world_.distance);
    clipper.places.resize(std::max(clipper.places.size(), b.count + 8));
    for (std::size_t i = 0; i < a.count; ++i) {
      FloatBox box;
      for (int k = 0; k < 3; ++k) {
        box.min[k] = a.low(k)[i];
        box.max[k] = a.high(k)[i];
      }
      std::size_t begin = 0;
      std::size_t end = b.count;
      if (is_sorted) {
        const float* values = b.low(axis).data();
        begin = static_cast<std::size_t>(
            std::lower_bound(values, values + b.count, (box.min[axis] - reach) - longest * 1.0001F) - values);
        end = static_cast<std::size_t>(
            std::upper_bound(values + begin, values + b.count, box.max[axis] + reach) - values);
      }
      std::uint32_t* const first = clipper.places.data();
      const std::uint32_t* const last = add_near(b, begin, end, box, limit, first);
      for (const std::uint32_t* place = first; place != last; ++place)
        if (ending_ == Ending::measured)
          add_if_near(world_, pair.a, a.index[i], pair.b, b.index[*place], clipper.found);
        else
          clipper.found.push_back({pair.a, pair.b, a.index[i], b.index[*place], 0});
    }
  }

  const World& world_;
  Ending ending_;
  Workers workers_;
  NearObjects near_;
  std::vector<BoxList> boxes_;  ///< of each object that is near another
  std::vector<std::uint64_t> versions_;
  std::vector<Clipper> clippers_;
};

}  // namespace

std::unique_ptr<Contender> make_clipping_triangles(const World& world, unsigned threads) {
  return std::make_unique<ClippingTriangles>(world, threads, Ending::measured);
}

std::unique_ptr<Contender> make_clipping_candidates(const World& world, Task /*task*/, unsigned threads) {
  return std::make_unique<ClippingTriangles>(world, threads, Ending::listed);
}

}  // namespace graze::bench
