// A scene that runs its steps on threads of the program's own, in place of oneTBB.
//
// The same balls fall into each other three times: with oneTBB, with a plain pool of threads, and with no
// threads at all. The reports have to be the same, bit for bit.

#include <Eigen/Geometry>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/support/shapes.hpp"
#include "examples/support/thread_pool.hpp"

namespace {

constexpr int balls = 60;
constexpr int steps = 20;

/// What is compared of a run, and how long its steps took.
struct Run {
  std::vector<double> numbers;  ///< distances and contact points of all steps
  double milliseconds = 0;
};

Run play(const std::shared_ptr<graze::TaskScheduler>& scheduler) {
  using Clock = std::chrono::steady_clock;
  const examples::Shape shape = examples::ball(0.5, 32, 15);
  const auto mesh =
      std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
  graze::Scene scene({.contact_distance = 0.02, .range = 0.2, .threads = 4}, scheduler);
  std::vector<graze::ObjectId> ids;
  for (int i = 0; i < balls; ++i) ids.push_back(scene.add(mesh, {.motion = graze::Motion::rigid}));
  Run run;
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < balls; ++i) {
      const Eigen::Vector3d place(i % 4, i / 4 % 4, i / 16);
      const double spacing = 1.05 - 0.005 * step;
      const Eigen::AngleAxisd turn(0.02 * step * (1 + i % 5), Eigen::Vector3d::UnitX());
      scene.set_pose(ids[static_cast<std::size_t>(i)], Eigen::Translation3d(spacing * place) * turn);
    }
    const Clock::time_point start = Clock::now();
    scene.step_async();
    const graze::ReportHandle report = scene.wait();
    run.milliseconds += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    for (const graze::PairReport& pair : report->pairs()) run.numbers.push_back(pair.distance.upper);
    for (const graze::Contact& contact : report->contacts())
      run.numbers.insert(run.numbers.end(), contact.point_a.data(), contact.point_a.data() + 3);
  }
  return run;
}

bool is_same(const Run& left, const Run& right) {
  return left.numbers.size() == right.numbers.size() &&
         std::memcmp(left.numbers.data(), right.numbers.data(), left.numbers.size() * sizeof(double)) == 0;
}

}  // namespace

int main() {
  const Run with_tbb = play(nullptr);
  const Run with_pool = play(std::make_shared<examples::ThreadPool>(3));
  const Run alone = play(std::make_shared<examples::SerialScheduler>());
  std::printf(
      "%d steps of %d balls: oneTBB %.1f ms, a pool of the program's own %.1f ms, no threads %.1f ms\n",
      steps, balls, with_tbb.milliseconds, with_pool.milliseconds, alone.milliseconds);
  const bool are_same = is_same(with_tbb, with_pool) && is_same(with_tbb, alone);
  std::printf("%zu numbers of the reports: %s\n", with_tbb.numbers.size(),
              are_same ? "the same" : "different");
  return are_same && with_tbb.numbers.size() > 1000 ? 0 : 1;
}
