#pragma once

#include <memory>
#include <vector>

#include "bench/contender.hpp"
#include "bench/peers/exact_distance.hpp"
#include "bench/peers/near_objects.hpp"
#include "bench/peers/triangle_boxes.hpp"
#include "bench/peers/workers.hpp"

namespace graze::bench {

/// A tree for each object, built when the object first comes near another, and after that refitted or rebuilt
/// in frames in which it has moved and is near one. A Tree is made of (world, task, object) at the present
/// positions, has `update()` for later ones and `match(other, found)` for pairs, where it is the lower
/// object's.
template <typename Tree>
class LazyTrees final : public Contender {
 public:
  LazyTrees(const World& world, Task task, unsigned threads)
      : world_(world),
        task_(task),
        workers_(threads),
        near_(world, workers_),
        trees_(world.objects.size()),
        versions_(world.objects.size()),
        found_(workers_.slots()) {}

  void frame() override {
    near_.update();
    workers_.each(near_.objects().size(), [&](std::size_t i, std::size_t) { update(near_.objects()[i]); });
    for (Found& found : found_) found.clear();
    workers_.each(near_.pairs().size(), [&](std::size_t i, std::size_t slot) {
      const ObjectPair& pair = near_.pairs()[i];
      trees_[pair.a]->match(*trees_[pair.b], found_[slot]);
    });
  }

  void collect(Found& all) const override {
    for (const Found& found : found_) {
      all.vertex_pairs.insert(all.vertex_pairs.end(), found.vertex_pairs.begin(), found.vertex_pairs.end());
      all.triangle_pairs.insert(all.triangle_pairs.end(), found.triangle_pairs.begin(),
                                found.triangle_pairs.end());
      all.distances.insert(all.distances.end(), found.distances.begin(), found.distances.end());
    }
  }

 private:
  void update(std::uint32_t object) {
    if (trees_[object] == nullptr)
      trees_[object] = std::make_unique<Tree>(world_, task_, object);
    else if (versions_[object] != world_.versions[object])
      trees_[object]->update();
    versions_[object] = world_.versions[object];
  }

  const World& world_;
  Task task_;
  Workers workers_;
  NearObjects near_;
  std::vector<std::unique_ptr<Tree>> trees_;
  std::vector<std::uint64_t> versions_;  ///< of the trees
  std::vector<Found> found_;
};

/// One object's vertices or triangles, as its tree sees them.
class Parts {
 public:
  Parts(const World& world, Task task, std::uint32_t object) : world_(&world), task_(task), object_(object) {}

  [[nodiscard]] std::uint32_t count() const {
    const WorldObject& object = world_->objects[object_];
    return task_ == Task::A ? object.vertex_count : static_cast<std::uint32_t>(object.triangles.size());
  }
  /// The box of one part.
  [[nodiscard]] FloatBox box(std::uint32_t part) const {
    const float* positions = world_->positions_of(object_);
    if (task_ != Task::A) return triangle_box(positions, world_->objects[object_].triangles[part]);
    const float* p = positions + 3 * std::size_t{part};
    return {{p[0], p[1], p[2]}, {p[0], p[1], p[2]}};
  }
  /// The box of one part, grown so much that the boxes of two near parts meet.
  [[nodiscard]] FloatBox grown_box(std::uint32_t part) const {
    return grown(box(part), 0.5 * world_->distance * (1 + 1e-5));
  }
  /// A candidate pair of a part here and one of a later object.
  void test(std::uint32_t part, const Parts& other, std::uint32_t other_part, Found& found) const {
    if (task_ != Task::A)
      return add_if_boxes_near(*world_, object_, part, other.object_, other_part, found.triangle_pairs);
    if (is_nearer(world_->positions_of(object_) + 3 * std::size_t{part},
                  world_->positions_of(other.object_) + 3 * std::size_t{other_part}, world_->distance))
      found.vertex_pairs.push_back({object_, other.object_, part, other_part});
  }

  [[nodiscard]] const World& world() const { return *world_; }
  [[nodiscard]] Task task() const { return task_; }
  [[nodiscard]] std::uint32_t object() const { return object_; }

 private:
  const World* world_;
  Task task_;
  std::uint32_t object_;
};

}  // namespace graze::bench
