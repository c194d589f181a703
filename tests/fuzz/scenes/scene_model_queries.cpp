// The model's side of queries between steps: what they must say of a report.

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/scene_query.hpp>

#include "fuzz/finding.hpp"
#include "scene_model.hpp"

namespace graze::fuzz {
namespace {

/// Coordinates so large are asked about nothing: a box around them may be beyond what a query takes.
constexpr double largest = 0x1p100;

/// Queries at one point of a report. Each answer is compared with answers of other kinds.
class QueriesAt {
 public:
  QueriesAt(const ReportHandle& report, const Eigen::Vector3d& point, double size)
      : query_(report), point_(point), rounding_(size * 0x1p-40) {}

  /// Checks that the object's closest point is at least as near as each of its vertices that counts.
  void check_closest(ObjectId id, const Positions& vertices) {
    const double distance = distance_of(id);
    for (const Eigen::Vector3d& vertex : vertices)
      expect(distance <= (vertex - point_).norm() + rounding_, "a vertex is nearer than the closest point");
  }
  /// Checks that the hits of a ray are sorted, and lie on the surfaces that they name.
  void check_ray(const Eigen::Vector3d& way) {
    if (way.isZero()) return;
    std::array<RayHit, 8> hits;
    const std::size_t count = query_.cast_ray(point_, way, 1, hits);
    const auto first = query_.cast_ray(point_, way, 1);
    expect(first.has_value() == (count > 0), "one ray hits and does not hit");
    if (first) expect(first->t == hits[0].t && first->object == hits[0].object, "another first hit");
    for (std::size_t i = 0; i < count; ++i) {
      expect(hits[i].t >= 0 && hits[i].t <= 1 && (i == 0 || hits[i - 1].t <= hits[i].t), "hits out of order");
      std::array<ClosestPoint, 4> near;
      const std::size_t near_count = query_.closest_points(hits[i].point, 2 * rounding_, near);
      expect(std::any_of(near.begin(), near.begin() + near_count,
                         [&](const ClosestPoint& one) { return one.object == hits[i].object; }),
             "a hit is not on the object that it names");
    }
  }
  /// Checks spheres that rest and boxes against the distance of the closest object.
  void check_reach() {
    const auto closest = query_.closest_point(point_);
    std::array<ObjectId, 4> listed;
    if (!closest)
      return expect(query_.objects_in_box(point_, point_, listed) == 0, "a box has what nothing is close to");
    const double distance = closest->distance;
    expect(std::abs((closest->point - point_).norm() - distance) <= rounding_,
           "the closest point is not there");
    expect(query_.cast_sphere(point_, point_, distance + rounding_).has_value(), "a sphere does not touch");
    if (distance > rounding_) {
      expect(!query_.cast_sphere(point_, point_, distance - rounding_), "a sphere touches what is far");
      const Eigen::Vector3d inner = Eigen::Vector3d::Constant((distance - rounding_) / 2);
      expect(query_.objects_in_box(point_ - inner, point_ + inner, listed) == 0, "a box has what is far");
    }
    const Eigen::Vector3d outer = Eigen::Vector3d::Constant(distance + rounding_);
    const std::size_t count = query_.objects_in_box(point_ - outer, point_ + outer, listed);
    expect(std::find(listed.begin(), listed.begin() + count, closest->object) != listed.begin() + count,
           "a box does not have what is near");
  }

 private:
  double distance_of(ObjectId id) {
    std::array<ClosestPoint, 4> closest;
    const std::size_t count = query_.closest_points(point_, std::numeric_limits<double>::infinity(), closest);
    for (std::size_t i = 0; i < count; ++i)
      if (closest[i].object == id) return closest[i].distance;
    return std::numeric_limits<double>::infinity();
  }

  SceneQuery query_;
  Eigen::Vector3d point_;
  double rounding_;
};

/// Whether a face that is not hidden has the vertex.
std::vector<bool> seen_vertices(const ModelBody& body) {
  std::vector<bool> seen(body.mesh->vertex_count());
  const auto& hidden = body.settings.hidden_groups;
  for (std::uint32_t face = 0; face < body.mesh->face_count(); ++face) {
    const std::uint8_t group = body.settings.face_groups.empty() ? 0 : body.settings.face_groups[face];
    if (std::find(hidden.begin(), hidden.end(), group) != hidden.end()) continue;
    for (const std::uint32_t corner : body.mesh->face(face)) seen[corner] = true;
  }
  return seen;
}

}  // namespace

void SceneModel::check_queries(const ReportHandle& report) const {
  std::map<ObjectId, Positions> asked;
  double size = 1;
  for (const ModelBody& body : bodies_) {
    const bool asks = body.is_alive && body.settings.queries;
    expect(report->mesh(body.id) == (body.is_alive ? body.mesh : nullptr), "a report has another mesh");
    const PositionView kept = report->positions(body.id);
    expect((kept.size() > 0) == asks, "a report keeps what it should not, or does not");
    if (!asks) continue;
    expect(kept.size() == body.mesh->vertex_count(), "a report keeps another number of positions");
    const std::vector<bool> is_seen = seen_vertices(body);
    const bool counts = body.settings.layer != 0 && body.settings.collides_with != 0;
    Positions& vertices = asked[body.id];
    for (std::uint32_t vertex = 0; vertex < kept.size(); ++vertex) {
      if (!body.mesh->is_used(vertex)) continue;
      if (body.settings.motion == Motion::deformable)
        expect(kept[vertex] == body.seen[vertex], "a report keeps other positions");
      size = std::max(size, kept[vertex].cwiseAbs().maxCoeff());
      if (is_seen[vertex] && counts) vertices.push_back(kept[vertex]);
    }
  }
  if (size > largest) return;
  for (const auto& [id, vertices] : asked) {
    if (vertices.empty()) continue;
    const Eigen::Vector3d point =
        vertices.front() + Eigen::Vector3d(0.375, -0.25, 0.125 * static_cast<double>(frame_ % 4));
    QueriesAt queries(report, point, size);
    queries.check_closest(id, vertices);
    queries.check_reach();
    queries.check_ray(2 * (vertices.back() - point));
  }
}

void SceneModel::check_patches(const ReportHandle& report) const {
  PatchRoom room;
  // The radius ends before a frozen object whose place is not known.
  const bool some_frozen = std::any_of(bodies_.begin(), bodies_.end(), [](const ModelBody& body) {
    return body.is_alive && (body.is_frozen || body.is_unseen);
  });
  for (const ModelBody& body : bodies_) {
    const Patch patch = report->patch(body.id);
    expect(static_cast<bool>(patch) == (body.is_alive && body.settings.patch_radius > 0),
           "a report has a patch that it should not have, or has none");
    if (!patch) continue;
    expect(patch.radius() <= body.settings.patch_radius, "a patch has another radius");
    expect(patch.is_cut() || some_frozen || patch.radius() == body.settings.patch_radius,
           "a patch is smaller for no reason");
    expect(patch.face_count() <= body.settings.patch_faces, "a patch has too many faces");
    if (body.settings.motion != Motion::deformable || body.is_frozen || patch.radius() == 0) continue;
    const double threshold = patch.radius() / 2;
    const PatchAnswer answer = patch.contacts(body.seen, threshold, room);
    expect(answer.complete && answer.threshold == threshold, "a patch does not know where its tool was");
    expect(answer.validity == patch.validity(body.seen, threshold), "a patch has two validities");
    for (const Contact& contact : room.contacts())
      expect(contact.distance < threshold || contact.kind == ContactKind::EF || contact.separation() < 0,
             "a patch lists what is not near");
  }
}

}  // namespace graze::fuzz
