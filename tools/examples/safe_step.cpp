// Throws a cloth onto a floor, edge first, so that it folds. Each time step minimises an energy by Newton's
// method, in the manner of Incremental Potential Contact (Li and others, 2020). A sweep to the end of each
// step of Newton's method says how far it may go: to 0.9 of the first time of impact, of the cloth with the
// floor and with itself. So nothing ever pierces, however large the steps are. With whole steps edges pierce.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/support/implicit_system.hpp"
#include "examples/support/record_option.hpp"

namespace {

using examples::Points;

constexpr double d_hat = 0.01;     // m, where the barrier begins: the contact distance
constexpr double stiffness = 200;  // N/m, of the barrier
constexpr double speed = 4;        // m/s, downwards at first
constexpr int steps = 30;          // of 1/60 s
constexpr int most_iterations = 30;
constexpr double tolerance = 1e-3;  // m, of a step of Newton's method

/// A cloth that falls on the floor.
class Simulation {
 public:
  Simulation(const examples::Body& floor, const examples::Body& cloth, bool is_safe) : is_safe_(is_safe) {
    objects_.push_back({floor.mesh, scene.add(floor.mesh, {.swept = true}), 0});
    objects_.push_back({cloth.mesh, scene.add(cloth.mesh, {.self = true, .self_rings = 0, .swept = true}),
                        floor.positions.size()});
    system_.time_step = 1.0 / 60;
    system_.gravity = {0, 0, -9.81};
    system_.add(floor);
    system_.add(cloth);
    look(system_.positions);
  }

  void step() {
    system_.begin_step();
    for (int i = 0; i < most_iterations; ++i) {
      const Points way = system_.newton_step(terms());
      if (examples::longest(way) < tolerance) break;
      search_line(way);
    }
    system_.end_step();
  }

  graze::Scene scene{graze::SceneSettings{.contact_distance = d_hat, .threads = 1}};
  std::size_t piercing = 0;  ///< edges that pierce a face at accepted positions, of all iterations
  int cut = 0;               ///< iterations that had to stop before an impact

 private:
  /// Returns the part of a way that is free, from where the last step saw the objects.
  double safe_part(const Points& way) {
    const Points end = examples::moved_along(system_.positions, 1, way);
    for (const examples::Object& object : objects_) scene.set_positions(object.id, object.of(end));
    const graze::ReportHandle report = scene.step();
    double impact = 1;
    for (const graze::PairReport& pair : report->pairs()) impact = std::min(impact, pair.time_of_impact);
    cut += impact < 1;
    return impact < 1 ? 0.9 * impact : 1;
  }

  /// Takes a report at some positions. The scene jumps there: the next sweep begins at them.
  void look(const Points& at) {
    for (const examples::Object& object : objects_)
      scene.set_positions(object.id, object.of(at), graze::teleport);
    report_ = scene.step();
  }

  /// Calls a function with the barrier of each contact of the last report.
  template <typename Use>
  void for_each_barrier(const Use& use) const {
    for (const graze::PairReport& pair : report_->pairs()) {
      const examples::Object& a = objects_[pair.a == objects_[0].id ? 0 : 1];
      const examples::Object& b = objects_[pair.b == objects_[0].id ? 0 : 1];
      for (const graze::Contact& contact : report_->contacts(pair))
        if (contact.kind != graze::ContactKind::EF)
          use(a, b, contact, examples::Barrier(contact.distance, d_hat, stiffness));
    }
  }

  [[nodiscard]] double potential(const Points& at) {
    double sum = system_.potential(at);
    for_each_barrier([&sum](const auto&, const auto&, const auto&, const examples::Barrier& barrier) {
      sum += barrier.value;
    });
    return sum;
  }

  [[nodiscard]] std::vector<examples::DistanceTerm> terms() const {
    const Points& at = system_.positions;
    std::vector<examples::DistanceTerm> terms = system_.spring_terms();
    for_each_barrier([&](const auto& a, const auto& b, const graze::Contact& contact, const auto& barrier) {
      examples::DistanceTerm& term = terms.emplace_back(contact.normal, barrier.slope, barrier.curvature);
      term.add(graze::weights(*a.mesh, a.of(at), contact.feature_a, contact.point_a), -1, a.first);
      term.add(graze::weights(*b.mesh, b.of(at), contact.feature_b, contact.point_b), 1, b.first);
    });
    return terms;
  }

  /// Goes along a way, at most as far as it is free. Where the potential does not fall, goes half as far.
  void search_line(const Points& way) {
    const Points from = system_.positions;
    const double before = potential(from);
    double factor = is_safe_ ? safe_part(way) : 1;
    for (int i = 0; i < 20; ++i, factor /= 2) {
      system_.positions = examples::moved_along(from, factor, way);
      look(system_.positions);
      if (potential(system_.positions) <= before) break;
    }
    for (const graze::Contact& contact : report_->contacts())
      piercing += contact.kind == graze::ContactKind::EF && contact.distance == 0;
  }

  bool is_safe_;
  std::vector<examples::Object> objects_;  ///< the floor and the cloth
  examples::ImplicitSystem system_;
  graze::ReportHandle report_;  ///< at the positions of now
};

/// Returns whether the cloth pierces something if steps are whole, and nothing if they are safe.
bool holds(bool is_safe, int argc, char** argv) {
  examples::Body cloth = examples::cloth(examples::hanging_sheet(0.4, 16, 0.03, 25), 0.1);
  for (examples::Spring& spring : cloth.springs) spring.compliance = 1e-3;
  cloth.velocities.assign(cloth.velocities.size(), {0, 0, -speed});
  Simulation simulation(examples::fixed_body(examples::floor_box(2, 0.1)), cloth, is_safe);
  const auto recorder = examples::recorder_by_options(argc, argv, simulation.scene);
  for (int step = 0; step < steps; ++step) simulation.step();
  std::printf("%s steps: %d cut, %zu edges pierce\n", is_safe ? "safe" : "whole", simulation.cut,
              simulation.piercing);
  return is_safe ? simulation.cut > 0 && simulation.piercing == 0 : simulation.piercing > 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool safe = holds(true, argc, argv);
  const bool whole = holds(false, argc, argv);
  std::printf("%s\n", safe && whole ? "safe steps pierce nothing" : "went wrong");
  return safe && whole ? 0 : 1;
}
