#include "experiment/paper/motion/soft_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/graze.hpp>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "mean_edge_length.hpp"
#include "springs/mass_spring_body.hpp"

namespace graze::tools {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;
using springs::MassSpringBody;
using springs::Points;

constexpr double grid = 0x1p-14;
constexpr double largest_coordinate = 512;
constexpr double nearest_allowed = 0.25;
constexpr double share_of_speed_error = 0.08;  ///< made good in one step
constexpr int iterations = 4;

Vector3d on_grid(const Vector3d& point) {
  return (point / grid).array().round().matrix() * grid;
}

Points points_of(const models::MeshData& mesh, const Eigen::Isometry3d& place) {
  Points points(static_cast<Eigen::Index>(mesh.positions.size()), 3);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = (place * mesh.positions[i]).transpose();
  return points;
}

std::vector<float> recorded(const Points& points) {
  std::vector<float> frame;
  for (Eigen::Index row = 0; row < points.rows(); ++row) {
    const Vector3d point = on_grid(points.row(row).transpose());
    if (!(point.cwiseAbs().maxCoeff() < largest_coordinate))
      throw std::runtime_error("a recorded motion left its grid");
    for (int axis = 0; axis < 3; ++axis) frame.push_back(static_cast<float>(point[axis]));
  }
  return frame;
}

/// A feature's vertices, and how much of each makes up a point on it. Faces are triangles.
struct Blend {
  std::array<std::uint32_t, 3> vertices{};
  std::array<double, 3> weights{};
  std::size_t count = 0;
};

Blend blend_of(const Mesh& mesh, const Points& points, const Feature& feature, const Vector3d& point) {
  const auto corner = [&](std::uint32_t vertex) -> Vector3d { return points.row(vertex).transpose(); };
  if (feature.kind == FeatureKind::vertex) return {{feature.index}, {1}, 1};
  if (feature.kind == FeatureKind::edge) {
    const auto [a, b] = mesh.edge(feature.index);
    const Vector3d along = corner(b) - corner(a);
    const double part = std::clamp((point - corner(a)).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return {{a, b}, {1 - part, part}, 2};
  }
  const auto face = mesh.face(feature.index);
  const Vector3d u = corner(face[1]) - corner(face[0]);
  const Vector3d v = corner(face[2]) - corner(face[0]);
  const Vector3d normal = u.cross(v);
  const Vector3d from = point - corner(face[0]);
  const double along_u = from.cross(v).dot(normal) / normal.squaredNorm();
  const double along_v = u.cross(from).dot(normal) / normal.squaredNorm();
  return {{face[0], face[1], face[2]}, {1 - along_u - along_v, along_u, along_v}, 3};
}

class Simulation {
 public:
  explicit Simulation(const SoftMotion& motion) : motion_(motion), scene_(settings(motion)) {
    for (const SoftBody& plan : motion.bodies) add(plan);
  }

  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh(std::size_t body) const { return actors_[body].mesh; }
  [[nodiscard]] const Points& positions(std::size_t body) const { return actors_[body].body.positions(); }

  /// False, and nothing moves, where bodies would come too near.
  bool step() {
    const std::vector<Points> forces = pushes();
    std::vector<Points> before;
    for (std::size_t i = 0; i < actors_.size(); ++i) {
      before.push_back(positions(i));
      if (motion_.bodies[i].soft) actors_[i].body.step(forces[i] + steering(i));
    }
    look();
    if (nearest_ >= nearest_allowed) return true;
    for (std::size_t i = 0; i < actors_.size(); ++i) actors_[i].body.set_positions(before[i]);
    return false;
  }

  /// Asks exact mode where everything is near.
  void look() {
    for (Actor& actor : actors_) actor.points = recorded(actor.body.positions());
    for (const Actor& actor : actors_)
      scene_.set_positions(actor.id, PositionView(actor.points.data(), actor.points.size() / 3));
    report_ = scene_.step();
    nearest_ = std::numeric_limits<double>::infinity();
    for (const Contact& contact : report_->contacts()) nearest_ = std::min(nearest_, contact.distance);
  }

 private:
  struct Actor {
    std::shared_ptr<const Mesh> mesh;
    MassSpringBody body;
    ObjectId id;
    std::vector<float> points;
  };

  static SceneSettings settings(const SoftMotion& motion) {
    SceneSettings settings;
    settings.contact_distance = motion.gap;
    settings.threads = 1;
    return settings;
  }

  void add(const SoftBody& plan) {
    auto mesh = std::make_shared<const Mesh>(
        Mesh::from_polygons(plan.rest.positions, plan.rest.corners, plan.rest.corner_counts));
    const double k = motion_.stiffness;
    MassSpringBody body(points_of(plan.rest, plan.start), springs::springs_of(plan.rest, {k, k, 0.5 * k}), 1,
                        1, iterations);
    const RowVector3d middle = body.positions().colwise().mean();
    const Points arms = body.positions().rowwise() - middle;
    body.set_velocities(arms * plan.flow.transpose());
    ObjectSettings settings;
    settings.name = plan.name;
    const ObjectId id = scene_.add(mesh, settings);
    actors_.push_back({std::move(mesh), std::move(body), id, {}});
  }

  /// Brings the body to its speed towards the meeting point, all vertices alike.
  [[nodiscard]] RowVector3d wanted_force(std::size_t index) const {
    const MassSpringBody& body = actors_[index].body;
    const RowVector3d way = motion_.meeting_point.transpose() - body.positions().colwise().mean();
    const RowVector3d wanted = motion_.bodies[index].speed * way / std::max(way.norm(), 1.0);
    return share_of_speed_error * (wanted - body.velocities().colwise().mean());
  }
  [[nodiscard]] Points steering(std::size_t index) const {
    return Points::Zero(positions(index).rows(), 3).rowwise() + wanted_force(index);
  }

  /// A force on each vertex, by the contacts that were last seen.
  [[nodiscard]] std::vector<Points> pushes() const {
    std::vector<Points> forces;
    for (std::size_t i = 0; i < actors_.size(); ++i)
      forces.emplace_back(Points::Zero(positions(i).rows(), 3));
    for (const PairReport& pair : report_->pairs()) {
      const std::size_t a = index_of(pair.a);
      const std::size_t b = index_of(pair.b);
      for (const Contact& contact : report_->contacts(pair)) {
        const RowVector3d force =
            motion_.push * (motion_.gap - contact.distance) * contact.normal.transpose();
        spread(blend_of(*mesh(a), positions(a), contact.feature_a, contact.point_a), -force, forces[a]);
        spread(blend_of(*mesh(b), positions(b), contact.feature_b, contact.point_b), force, forces[b]);
      }
    }
    return forces;
  }
  static void spread(const Blend& blend, const RowVector3d& force, Points& forces) {
    for (std::size_t i = 0; i < blend.count; ++i) forces.row(blend.vertices[i]) += blend.weights[i] * force;
  }
  [[nodiscard]] std::size_t index_of(ObjectId id) const {
    const auto found = std::ranges::find_if(actors_, [&](const Actor& actor) { return actor.id == id; });
    return static_cast<std::size_t>(found - actors_.begin());
  }

  const SoftMotion& motion_;
  Scene scene_;
  std::vector<Actor> actors_;
  ReportHandle report_;
  double nearest_ = 0;
};

RecordedMotion empty_recording(const SoftMotion& motion, const Simulation& simulation) {
  RecordedMotion recording;
  recording.name = motion.name;
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const SoftBody& body = motion.bodies[i];
    meshes.push_back(simulation.mesh(i));
    recording.objects.push_back({body.name, body.kind, body.kind_id, 0, body.rest, meshes.back(), {}});
  }
  recording.mean_edge_length = mean_edge_length(meshes);
  return recording;
}

}  // namespace

RecordedMotion record_soft_motion(const SoftMotion& motion, std::size_t frames) {
  SoftMotion rounded = motion;
  for (SoftBody& body : rounded.bodies)
    for (Vector3d& position : body.rest.positions) position = on_grid(position);
  Simulation simulation(rounded);
  RecordedMotion recording = empty_recording(rounded, simulation);
  simulation.look();
  bool moving = true;
  std::size_t step = 0;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::size_t due = frames == 1 ? 0 : frame * (motion.steps - 1) / (frames - 1);
    for (; step < due && moving; ++step) moving = simulation.step();
    for (std::size_t i = 0; i < recording.objects.size(); ++i)
      recording.objects[i].frames.push_back(recorded(simulation.positions(i)));
  }
  return recording;
}

}  // namespace graze::tools
