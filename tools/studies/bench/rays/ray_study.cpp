#include "bench/rays/ray_study.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <graze/graze.hpp>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/run.hpp"
#include "bench/stopwatch.hpp"
#include "distribution.hpp"
#include "progress.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

constexpr std::size_t rays_of_frame = 10'000;

/// A scene that is stepped to be asked, and a query for each thread.
class GrazeRays final : public RayCaster {
 public:
  GrazeRays(const BenchScene& bench, const World& world, unsigned threads)
      : scene_({.detail = ContactDetail::none, .threads = threads}), queries_(threads) {
    for (std::size_t i = 0; i < bench.bodies.size(); ++i) {
      const Body& body = bench.bodies[i];
      // In one group, so that a step tests no pair.
      ids_.push_back(scene_.add(body.mesh, {.group = 1, .queries = true}));
      scene_.bind_positions(ids_[i], PositionView(world.positions_of(i), body.mesh->vertex_count()));
    }
  }

  void update() override {
    const ReportHandle report = scene_.step();
    for (SceneQuery& query : queries_) query.set_report(report);
  }

  void cast(std::span<const Ray> rays, std::span<FirstHit> hits, unsigned thread) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = first_hit(rays[i], queries_[thread]);
  }

 private:
  [[nodiscard]] FirstHit first_hit(const Ray& ray, SceneQuery& query) const {
    const auto hit = query.cast_ray(Eigen::Map<const Eigen::Vector3f>(ray.origin).cast<double>(),
                                    Eigen::Map<const Eigen::Vector3f>(ray.direction).cast<double>());
    if (!hit) return {};
    const auto found = std::find(ids_.begin(), ids_.end(), hit->object);
    return {static_cast<std::uint32_t>(found - ids_.begin()), hit->t};
  }

  Scene scene_;
  std::vector<ObjectId> ids_;
  std::vector<SceneQuery> queries_;
};

/// Rays from around a world to points of the boxes of its objects. So most of them hit something.
class RayMaker {
 public:
  explicit RayMaker(const World& world) : world_(world) {}

  void make(std::vector<Ray>& rays) {
    std::vector<Eigen::AlignedBox3f> boxes;
    Eigen::AlignedBox3f all;
    for (std::size_t i = 0; i < world_.objects.size(); ++i) {
      boxes.emplace_back();
      const float* const positions = world_.positions_of(i);
      for (std::size_t vertex = 0; vertex < world_.objects[i].vertex_count; ++vertex)
        boxes.back().extend(Eigen::Vector3f(positions + 3 * vertex));
      all.extend(boxes.back());
    }
    for (Ray& ray : rays) {
      const Eigen::Vector3f from = all.center() + all.diagonal().norm() * direction();
      const auto& box = boxes[random_.below(boxes.size())];
      const Eigen::Vector3f to = point_in(box);
      Eigen::Map<Eigen::Vector3f>(ray.origin) = from;
      Eigen::Map<Eigen::Vector3f>(ray.direction) = (to - from).normalized();
    }
  }

 private:
  Eigen::Vector3f direction() {
    Eigen::Vector3d made;
    do made = random_.vector(-1, 1);
    while (made.squaredNorm() > 1 || made.squaredNorm() < 0.01);
    return made.normalized().cast<float>();
  }
  Eigen::Vector3f point_in(const Eigen::AlignedBox3f& box) {
    Eigen::Vector3f made;
    for (int axis = 0; axis < 3; ++axis)
      made[axis] = static_cast<float>(random_.between(box.min()[axis], box.max()[axis]));
    return made;
  }

  const World& world_;
  scenes::Random random_{1};
};

/// One library in a study, with what it has found and how long that took.
struct Contestant {
  std::string name;
  std::unique_ptr<RayCaster> caster;
  std::vector<FirstHit> hits = std::vector<FirstHit>(rays_of_frame);
  std::vector<double> update_ms;
  std::vector<double> ray_ns;
  std::uint64_t hit = 0;       ///< rays
  std::uint64_t missed = 0;    ///< rays that hit something, but not here
  std::uint64_t mistaken = 0;  ///< rays that hit something else first, or nothing
  double worst = 0;            ///< relative error of a distance
};

void cast_all(Contestant& contestant, std::span<const Ray> rays, unsigned threads) {
  const auto part = [&](unsigned thread) {
    const std::size_t begin = rays.size() * thread / threads;
    const std::size_t count = rays.size() * (thread + 1) / threads - begin;
    contestant.caster->cast(rays.subspan(begin, count), std::span(contestant.hits).subspan(begin, count),
                            thread);
  };
  const Stopwatch watch(threads);
  {
    std::vector<std::jthread> others;
    for (unsigned thread = 1; thread < threads; ++thread) others.emplace_back(part, thread);
    part(0);
  }
  contestant.ray_ns.push_back(1e6 * watch.ms() / static_cast<double>(rays.size()));
}

/// The truth is what graze has found, which tests compare with exact arithmetic.
void compare(Contestant& contestant, std::span<const FirstHit> truth) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const FirstHit& found = contestant.hits[i];
    const bool hits = found.object != FirstHit::no_object;
    contestant.hit += hits;
    if (found.object != truth[i].object) {
      ++(hits ? contestant.mistaken : contestant.missed);
    } else if (hits) {
      contestant.worst = std::max(contestant.worst, std::abs(found.t - truth[i].t) / truth[i].t);
    }
  }
}

std::vector<Contestant> contestants_of(const PeerModule& module, const BenchScene& scene, const World& world,
                                       unsigned threads) {
  std::vector<Contestant> contestants(1);
  contestants[0].name = graze_name;
  contestants[0].caster = std::make_unique<GrazeRays>(scene, world, threads);
  for (const auto& [name, tree] :
       {std::pair("Embree rebuilt", RayTree::rebuilt), std::pair("Embree refitted", RayTree::refitted)}) {
    std::unique_ptr<RayCaster> caster = module.ray_caster(world, tree, threads);
    if (caster == nullptr) break;
    contestants.emplace_back();
    contestants.back().name = name;
    contestants.back().caster = std::move(caster);
  }
  return contestants;
}

}  // namespace

RayStudy::RayStudy()
    : table_{"rays", "The first hits of rays, of graze and of Embree",
             tools::columns_of({"scene", "threads", "library", "update_ms: ms a frame to take up positions",
                                "ray_ns: ns a ray", "hit: rays that hit",
                                "missed: of these, where graze hits and this does not",
                                "mistaken: another object first, or one where graze hits none",
                                "worst: largest relative error of a distance"})} {
  table_.timed = true;
}

void RayStudy::add(const PeerModule& module, const BenchScene& scene, std::size_t frames, unsigned threads) {
  MovingWorld moving(scene);
  moving.place(0);
  std::vector<Contestant> contestants = contestants_of(module, scene, moving.world(), threads);
  for (Contestant& contestant : contestants) contestant.caster->update();  // builds what others refit
  RayMaker maker(moving.world());
  std::vector<Ray> rays(rays_of_frame);
  const std::size_t count = frames == 0 ? scene.frames : frames;
  tools::Progress progress(scene.name + ": frame", count);
  for (std::size_t frame = 0; frame < count; ++frame) {
    progress.at(frame);
    moving.place(frame + 1);
    maker.make(rays);
    for (Contestant& contestant : contestants) {
      const Stopwatch watch(threads);
      contestant.caster->update();
      contestant.update_ms.push_back(watch.ms());
      cast_all(contestant, rays, threads);
      compare(contestant, contestants[0].hits);
    }
  }
  for (const Contestant& contestant : contestants)
    table_.rows.push_back({scene.name, std::uint64_t{threads}, contestant.name,
                           tools::Distribution(contestant.update_ms).median(),
                           tools::Distribution(contestant.ray_ns).median(), contestant.hit, contestant.missed,
                           contestant.mistaken, contestant.worst});
}

}  // namespace graze::bench
