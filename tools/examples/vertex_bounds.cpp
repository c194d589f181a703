// Drops a cloth onto a ball, fast, and lets each vertex go as far as is safe for it: nearly half of the
// distance to what is near its faces. So no edge ever pierces a face, without a sweep, and what is near the
// ball does not hold up the rest. This is the bound of Offset Geometric Contact (Chen and others, 2025). With
// one bound for all vertices, that of the nearest one, the cloth falls more slowly than it should.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <graze/graze.hpp>
#include <span>
#include <vector>

#include "examples/support/body.hpp"
#include "examples/support/record_option.hpp"
#include "examples/support/shapes.hpp"
#include "examples/support/xpbd.hpp"

namespace {

using examples::Points;

constexpr double reach = 0.015;      // m, how far features see each other: less than a cell of the cloth
constexpr double thickness = 0.008;  // m, the gap that the solver keeps where it can
constexpr double part = 0.45;        // of a distance that either side may go, less than a half
constexpr double speed = 5;          // m/s, downwards at first: 8 cm in a time step
constexpr double time_step = 1.0 / 60;
constexpr int steps = 60;
constexpr int rounds = 4;        // in each time step: a scene's step, and a move
constexpr double radius = 0.15;  // m, of the ball

/// Two points that a contact keeps apart. Those of the ball do not move, and have no vertices.
struct Apart {
  graze::SurfaceWeights a, b;
  Eigen::Vector3d point_a, point_b, normal;
};

/// A cloth above a ball that does not move.
class Simulation {
 public:
  explicit Simulation(bool one_bound_for_all) : one_bound_for_all_(one_bound_for_all) {
    cloth_.velocities.assign(cloth_.velocities.size(), {0, 0, -speed});
    for (Eigen::Vector3d& point : cloth_.positions) point.z() += 0.3;
    scene.add(ball_.mesh);
    id_ = scene.add(cloth_.mesh, {.self = true, .self_rings = 0, .self_at_rest = true});
    safe_ = cloth_.positions;
    look();
  }

  /// Goes towards where springs and contacts want the vertices, as far as the rounds come.
  void step() {
    examples::predict(cloth_, {0, 0, -9.81}, 1, time_step);
    for (int round = 0; round < rounds; ++round) {
      for (int i = 0; i < 10; ++i) {
        examples::solve_springs(cloth_, time_step);
        for (const Apart& pair : apart_) keep_apart(pair);
      }
      move();
    }
    cloth_.positions = safe_;
    examples::update_velocities(cloth_, time_step);
  }

  /// Whether some vertex is lower than the ball.
  [[nodiscard]] bool is_past() const {
    return std::ranges::any_of(safe_, [](const Eigen::Vector3d& point) { return point.z() < -radius; });
  }

  graze::Scene scene{graze::SceneSettings{.contact_distance = reach, .threads = 1}};
  double nearest = reach;    ///< m, the least distance of any contact
  std::size_t piercing = 0;  ///< edges that pierce a face, of all rounds

 private:
  /// Looks at where the vertices are: finds how far each may go, and what is to be kept apart.
  void look() {
    scene.set_positions(id_, safe_);
    const graze::ReportHandle report = scene.step();
    bounds_.assign(safe_.size(), part * reach);
    apart_.clear();
    for (const graze::PairReport& pair : report->pairs())
      for (const graze::Contact& contact : report->contacts(pair)) {
        Apart& points = apart_.emplace_back(Apart{{}, {}, contact.point_a, contact.point_b, contact.normal});
        if (pair.a == id_) points.a = take(contact.feature_a, contact.point_a, contact.distance);
        if (pair.b == id_) points.b = take(contact.feature_b, contact.point_b, contact.distance);
        piercing += contact.kind == graze::ContactKind::EF && contact.distance == 0;
        nearest = std::min(nearest, contact.distance);
      }
    if (one_bound_for_all_) bounds_.assign(safe_.size(), *std::ranges::min_element(bounds_));
  }

  /// Bounds the corners of all faces that have a feature. Any two faces within reach of each other have a
  /// contact of features of theirs, so each of their corners is bounded by their distance.
  graze::SurfaceWeights take(const graze::Feature& feature, const Eigen::Vector3d& point, double distance) {
    const graze::Mesh& mesh = *cloth_.mesh;
    std::span<const std::uint32_t> faces{&feature.index, 1};
    if (feature.kind == graze::FeatureKind::vertex) faces = mesh.vertex_faces(feature.index);
    if (feature.kind == graze::FeatureKind::edge) faces = mesh.edge_faces(feature.index);
    for (const std::uint32_t face : faces)
      for (const std::uint32_t corner : mesh.face(face))
        bounds_[corner] = std::min(bounds_[corner], part * distance);
    return graze::weights(mesh, safe_, feature, point);
  }

  /// The surfaces have never met, so whatever side they show, they are kept apart along the normal.
  void keep_apart(const Apart& pair) {
    const auto at = [&](const graze::SurfaceWeights& of, const Eigen::Vector3d& fixed) {
      Eigen::Vector3d sum = of.count == 0 ? fixed : Eigen::Vector3d(0, 0, 0);
      for (std::size_t i = 0; i < 4; ++i) sum += of.weight[i] * cloth_.positions[of.vertex[i]];
      return sum;
    };
    const double missing = thickness - pair.normal.dot(at(pair.b, pair.point_b) - at(pair.a, pair.point_a));
    if (missing <= 0) return;
    double squares = 0;
    for (const double weight : pair.a.weight) squares += weight * weight;
    for (const double weight : pair.b.weight) squares += weight * weight;
    const Eigen::Vector3d push = missing / squares * pair.normal;
    for (std::size_t i = 0; i < 4; ++i) cloth_.positions[pair.a.vertex[i]] -= pair.a.weight[i] * push;
    for (std::size_t i = 0; i < 4; ++i) cloth_.positions[pair.b.vertex[i]] += pair.b.weight[i] * push;
  }

  void move() {
    for (std::size_t v = 0; v < safe_.size(); ++v) {
      const Eigen::Vector3d way = cloth_.positions[v] - safe_[v];
      const double length = way.norm();
      safe_[v] += length <= bounds_[v] ? way : Eigen::Vector3d(way * (bounds_[v] / length));
    }
    look();
  }

  bool one_bound_for_all_;
  examples::Body ball_ = examples::fixed_body(examples::ball(radius, 32, 20));
  examples::Body cloth_ = examples::cloth(examples::sheet(0.6, 25), 0.1);  ///< where it wants to be
  graze::ObjectId id_;
  Points safe_;                 ///< where it is
  std::vector<double> bounds_;  ///< m, how far each vertex may go from there
  std::vector<Apart> apart_;
};

/// Returns how many time steps the cloth takes to hang down below the ball, or -1 if anything pierced.
int run(bool one_bound_for_all, int argc, char** argv) {
  Simulation simulation(one_bound_for_all);
  const auto recorder = examples::recorder_by_options(argc, argv, simulation.scene);
  int taken = 0;
  while (taken < steps && !simulation.is_past()) {
    simulation.step();
    ++taken;
  }
  std::printf("%s: past the ball in %d steps, %zu edges pierce, nearest %.4f m\n",
              one_bound_for_all ? "one bound for all" : "a bound for each", taken, simulation.piercing,
              simulation.nearest);
  return simulation.piercing == 0 && simulation.nearest > 0 ? taken : -1;
}

}  // namespace

int main(int argc, char** argv) {
  const int each = run(false, argc, argv);
  const int all = run(true, argc, argv);
  return each > 0 && 4 * each < 3 * all ? 0 : 1;
}
