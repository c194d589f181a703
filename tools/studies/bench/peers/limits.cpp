#include <algorithm>

#include "bench/peers/near_objects.hpp"
#include "bench/peers/peers.hpp"
#include "bench/peers/simd.hpp"
#include "bench/peers/workers.hpp"

namespace graze::bench {
namespace {

class ReadLimit final : public Contender {
 public:
  ReadLimit(const World& world, unsigned threads) : world_(world), workers_(threads) {}

  void frame() override {
    constexpr std::size_t piece = 16'384;
    const std::vector<float>& all = world_.positions;
    sums_.resize((all.size() + piece - 1) / piece);
    workers_.each(sums_.size(), [&](std::size_t i, std::size_t) {
      sums_[i] = sum_of(all.data() + i * piece, std::min(piece, all.size() - i * piece));
    });
  }
  void collect(Found&) const override {}

 private:
  const World& world_;
  Workers workers_;
  std::vector<float> sums_;
};

class BoxLimit final : public Contender {
 public:
  BoxLimit(const World& world, unsigned threads)
      : world_(world), workers_(threads), boxes_(world.objects.size()) {}

  void frame() override {
    constexpr std::size_t block = 64;  // of objects
    const std::size_t count = boxes_.size();
    workers_.each((count + block - 1) / block, [&](std::size_t k, std::size_t) {
      for (std::size_t i = k * block; i < std::min(count, (k + 1) * block); ++i)
        boxes_[i] = box_of(world_.positions_of(i), world_.objects[i].vertex_count);
    });
  }
  void collect(Found&) const override {}

 private:
  const World& world_;
  Workers workers_;
  std::vector<FloatBox> boxes_;
};

class MoversLimit final : public Contender {
 public:
  MoversLimit(const World& world, unsigned threads)
      : world_(world), workers_(threads), sums_(world.objects.size()) {}

  void frame() override {
    if (objects_.empty()) find_movers();
    workers_.each(objects_.size(), [&](std::size_t i, std::size_t) {
      const std::uint32_t object = objects_[i];
      sums_[i] = sum_of(world_.positions_of(object), 3 * std::size_t{world_.objects[object].vertex_count});
    });
  }
  void collect(Found&) const override {}

 private:
  void find_movers() {
    NearObjects near(world_, workers_);
    near.update();
    const auto moves = [&](std::size_t object) { return world_.versions[object] > 1; };
    std::vector<char> is_read(world_.objects.size());
    for (std::size_t i = 0; i < is_read.size(); ++i) is_read[i] = moves(i) ? 1 : 0;
    for (const ObjectPair& pair : near.pairs())
      if (moves(pair.a) || moves(pair.b)) is_read[pair.a] = is_read[pair.b] = 1;
    for (std::uint32_t i = 0; i < is_read.size(); ++i)
      if (is_read[i] != 0) objects_.push_back(i);
  }

  const World& world_;
  Workers workers_;
  std::vector<std::uint32_t> objects_;  ///< what is read: found in the first frame in which anything moved
  std::vector<float> sums_;
};

}  // namespace

std::unique_ptr<Contender> make_movers_limit(const World& world, Task, unsigned threads) {
  return std::make_unique<MoversLimit>(world, threads);
}

std::unique_ptr<Contender> make_read_limit(const World& world, Task, unsigned threads) {
  return std::make_unique<ReadLimit>(world, threads);
}

std::unique_ptr<Contender> make_box_limit(const World& world, Task, unsigned threads) {
  return std::make_unique<BoxLimit>(world, threads);
}

}  // namespace graze::bench
