#include "examples/support/xpbd.hpp"

namespace examples {

void predict(Body& body, const Eigen::Vector3d& gravity, double damping, double time_step) {
  body.previous = body.positions;
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    if (body.inverse_masses[i] > 0)
      body.velocities[i] = (1 - damping * time_step) * (body.velocities[i] + time_step * gravity);
    body.positions[i] += time_step * body.velocities[i];
  }
  for (Spring& spring : body.springs) spring.multiplier = 0;
}

void solve_springs(Body& body, double time_step) {
  for (Spring& spring : body.springs) {
    Eigen::Vector3d& a = body.positions[spring.a];
    Eigen::Vector3d& b = body.positions[spring.b];
    const Eigen::Vector3d apart = b - a;
    const double length = apart.norm();
    if (length == 0) continue;
    const double inverse_a = body.inverse_masses[spring.a];
    const double inverse_b = body.inverse_masses[spring.b];
    const double compliance = spring.compliance / (time_step * time_step);
    const double change =
        (spring.rest_length - length - compliance * spring.multiplier) / (inverse_a + inverse_b + compliance);
    spring.multiplier += change;
    a -= inverse_a * change / length * apart;
    b += inverse_b * change / length * apart;
  }
}

void update_velocities(Body& body, double time_step) {
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    body.velocities[i] = (body.positions[i] - body.previous[i]) / time_step;
}

}  // namespace examples
