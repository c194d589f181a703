// Drops a soft ball onto a cloth that is held at its border. A barrier keeps them apart: a potential that is
// 0 where two features are `d_hat` apart, and grows without end as they come to touch. Each time step
// minimises inertia, springs and barriers together, by Newton's method with line search, in the manner of
// Incremental Potential Contact (Li and others, 2020). No distance is ever 0, and the energy falls, at a time
// step of 1/60 s.
//
// Between two reports `evaluate` gives the distances of the contacts of the last report at new positions. A
// report also says how far its surfaces are apart. Until vertices have moved half as far, nothing can have
// passed through, whatever features are nearest by then. Before that a new report is taken.

#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <graze/graze.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "examples/support/implicit_system.hpp"
#include "examples/support/record_option.hpp"

namespace {

using examples::Points;

constexpr double d_hat = 0.01;             // m, where the barrier begins
constexpr double contact_distance = 0.02;  // m, of the scene: d_hat and a margin
constexpr double stiffness = 200;          // N/m, of the barrier
constexpr int steps = 60;
constexpr int most_iterations = 50;
constexpr double tolerance = 1e-4;  // m, of a step of Newton's method

/// Two bodies, a scene of them, and its last report.
class Simulation {
 public:
  Simulation(graze::Scene& scene, const examples::Body& a, const examples::Body& b)
      : scene_(scene), a_{a.mesh, scene.add(a.mesh), 0}, b_{b.mesh, scene.add(b.mesh), a.positions.size()} {
    system_.time_step = 1.0 / 60;
    system_.gravity = {0, 0, -9.81};
    system_.add(a);
    system_.add(b);
    look();
  }
  void step() {
    system_.begin_step();
    for (int i = 0; i < most_iterations; ++i) {
      if (examples::largest_motion(seen_, system_.positions) > reach_ / 2) look();
      const Points way = system_.newton_step(terms());
      if (examples::longest(way) < tolerance) break;
      search_line(way);
    }
    system_.end_step();
  }
  [[nodiscard]] double energy() const { return system_.energy() + barriers(system_.positions); }

  double least_distance = std::numeric_limits<double>::infinity();  ///< so far, negative on the wrong side

 private:
  /// Takes a report, and says how far vertices may move until the next one. The range of the scene is
  /// infinite, so its only pair is always listed, with the distance of the surfaces.
  void look() {
    for (const examples::Object* object : {&a_, &b_})
      scene_.set_positions(object->id, object->of(system_.positions));
    report_ = scene_.step();
    seen_ = system_.positions;
    const double apart = report_->pairs()[0].distance.lower;
    least_distance = std::min(least_distance, apart);
    // Both may move, so each has half of the distance. Surfaces that are no contact now stay d_hat apart.
    reach_ = std::max(apart - d_hat, std::min(apart, contact_distance - d_hat)) / 2;
  }

  [[nodiscard]] graze::ContactGeometry evaluate(const graze::Contact& contact, const Points& at) const {
    return graze::evaluate(*a_.mesh, a_.of(at), *b_.mesh, b_.of(at), contact);
  }

  [[nodiscard]] double barriers(const Points& at) const {
    double sum = 0;
    for (const graze::Contact& contact : report_->contacts())
      sum += examples::Barrier(evaluate(contact, at).distance, d_hat, stiffness).value;
    return sum;
  }

  /// Returns a term of the potential for each spring, and for each contact.
  [[nodiscard]] std::vector<examples::DistanceTerm> terms() const {
    const Points& at = system_.positions;
    std::vector<examples::DistanceTerm> terms = system_.spring_terms();
    for (const graze::Contact& contact : report_->contacts()) {
      const graze::ContactGeometry now = evaluate(contact, at);
      const examples::Barrier barrier(now.distance, d_hat, stiffness);
      examples::DistanceTerm& term = terms.emplace_back(now.normal, barrier.slope, barrier.curvature);
      term.add(graze::weights(*a_.mesh, a_.of(at), contact.feature_a, now.point_a), -1, a_.first);
      term.add(graze::weights(*b_.mesh, b_.of(at), contact.feature_b, now.point_b), 1, b_.first);
    }
    return terms;
  }

  /// Goes along a step, as far as the last report holds. Where the potential does not fall, goes half as far.
  void search_line(const Points& way) {
    const Points from = system_.positions;
    const double before = system_.potential(from) + barriers(from);
    const double room = 0.9 * reach_ - examples::largest_motion(seen_, from);
    double factor = std::min(1.0, room / examples::longest(way));
    do {
      system_.positions = examples::moved_along(from, factor, way);
      factor /= 2;
    } while (system_.potential(system_.positions) + barriers(system_.positions) > before);
    for (const graze::Contact& contact : report_->contacts())
      least_distance = std::min(least_distance, evaluate(contact, system_.positions).separation);
  }

  graze::Scene& scene_;
  examples::Object a_;
  examples::Object b_;
  examples::ImplicitSystem system_;
  graze::ReportHandle report_;
  Points seen_;       ///< the positions of the last report
  double reach_ = 0;  ///< how far any vertex may move from there
};

}  // namespace

int main(int argc, char** argv) {
  graze::Scene scene({.contact_distance = contact_distance,
                      .range = std::numeric_limits<double>::infinity(),
                      .detail = graze::ContactDetail::nearest,
                      .threads = 1});
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, scene);
  examples::Body cloth = examples::cloth(examples::sheet(1, 17), 0.5);
  for (examples::Spring& spring : cloth.springs) spring.compliance = 1e-3;
  examples::hold_border(cloth);
  const Eigen::Vector3d start(0.02, 0.01, 0.3);
  const examples::Shape ball = moved(examples::ball(0.15, 12, 7), start);
  Simulation simulation(scene, cloth, examples::soft_ball(ball, start, 1, 1e-3));
  double energy = simulation.energy();
  const double energy_before = energy;
  double rise = 0;  // most in one step
  for (int step = 1; step <= steps; ++step) {
    simulation.step();
    rise = std::max(rise, simulation.energy() - energy);
    energy = simulation.energy();
    if (step % 20 == 0)
      std::printf("step %d: %.3f J, least distance %.6f m\n", step, energy, simulation.least_distance);
  }
  std::printf("least distance %.6f m; energy from %.3f to %.3f J, at most %.4f J more in a step\n",
              simulation.least_distance, energy_before, energy, rise);
  return simulation.least_distance > 0 && energy < 0.5 * energy_before && rise < 0.01 ? 0 : 1;
}
