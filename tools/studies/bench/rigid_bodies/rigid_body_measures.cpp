#include "bench/rigid_bodies/rigid_body_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace graze::bench {
namespace {

constexpr double touching = 0.002;  // m, contacts that may carry
constexpr double jump = 0.005;      // m
constexpr double in_place = 0.02;   // m

/// Calls `use` with how far each body that was put somewhere is from that height, in m.
template <typename Use>
void for_each_error(const RigidBodyScene& scene, std::span<const rigid::Body> now, const Use& use) {
  for (std::size_t i = 0; i < scene.heights.size(); ++i)
    use(std::abs(now[i + 1].position.z() - scene.heights[i]));
}

}  // namespace

double speed_between(const RigidBodyScene& scene, std::span<const rigid::Body> before,
                     std::span<const rigid::Body> now, double time_step) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].inverse_mass == 0) continue;
    double way = 0;
    for (const Eigen::Vector3d& point : scene.shapes[i]->mesh->rest())
      way = std::max(way, (now[i].to_world(point) - before[i].to_world(point)).norm());
    sum += 1000 * way / time_step;
    ++count;
  }
  return sum / static_cast<double>(count);
}

double height_error(const RigidBodyScene& scene, std::span<const rigid::Body> now) {
  double worst = 0;
  for_each_error(scene, now, [&](double error) { worst = std::max(worst, 1000 * error); });
  return worst;
}

std::size_t standing(const RigidBodyScene& scene, std::span<const rigid::Body> now) {
  std::size_t count = 0;
  for_each_error(scene, now, [&](double error) { count += error < in_place ? 1 : 0; });
  return count;
}

void ContactJumps::see(std::span<const rigid::Body> bodies, std::span<const rigid::Contact> contacts) {
  const auto pair_of = [](const Point& point) { return std::pair(point.a, point.b); };
  last_.swap(now_);
  now_.clear();
  for (const rigid::Contact& contact : contacts) {
    // Some sources name the bodies of a pair in either order.
    const bool is_ordered = contact.a < contact.b;
    const std::uint32_t a = is_ordered ? contact.a : contact.b;
    const std::uint32_t b = is_ordered ? contact.b : contact.a;
    now_.push_back({a, b, bodies[b].to_own(is_ordered ? contact.on_b : contact.on_a)});
    if (contact.separation >= touching) continue;
    ++touching_;
    const auto same_pair = std::ranges::equal_range(last_, std::pair(a, b), {}, pair_of);
    const bool was_there = std::ranges::any_of(
        same_pair, [&](const Point& point) { return (point.on_b - now_.back().on_b).norm() < jump; });
    jumped_ += was_there ? 0 : 1;
  }
  std::ranges::sort(now_, {}, pair_of);
}

double ContactJumps::share() const {
  return touching_ == 0 ? 0 : static_cast<double>(jumped_) / static_cast<double>(touching_);
}

}  // namespace graze::bench
