#include <array>
#include <cmath>
#include <graze/error.hpp>
#include <graze/scene_query.hpp>
#include <string>
#include <utility>

#include "core/base/floating_point_scope.hpp"
#include "core/cast/box_overlap.hpp"
#include "core/cast/closest_point.hpp"
#include "core/cast/ray_cast.hpp"
#include "core/cast/sphere_cast.hpp"
#include "geometry/kept_geometry.hpp"
#include "geometry/mesh_probe.hpp"
#include "geometry/query_rows.hpp"

namespace graze {
namespace {

void check_point(const Eigen::Vector3d& point, const char* name) {
  if (!Surface::is_within_limits(point))
    throw Error(std::string("query: ") + name + " is not finite, or beyond 2^120");
}

/// A distance that is 0 or more, and finite unless `may_be_infinite`.
void check_distance(double distance, const char* name, bool may_be_infinite) {
  if (!(distance >= 0) || (!may_be_infinite && !(distance <= 0x1p120)))
    throw Error(std::string("query: ") + name + " is negative, not a number, or beyond 2^120");
}

}  // namespace

struct SceneQuery::State {
  ReportHandle report;
  ClosestPointSearch closest;
  // Memory for the queries that list nothing.
  std::array<RayHit, 1> ray_hit;
  std::array<SphereHit, 1> sphere_hit;
  std::array<ClosestPoint, 1> closest_point;

  [[nodiscard]] const KeptGeometry* geometry() const { return report ? report->geometry_.get() : nullptr; }
};

SceneQuery::SceneQuery(ReportHandle report) {
  const FloatingPointScope scope;
  state_ = std::make_unique<State>();
  set_report(std::move(report));
}
SceneQuery::~SceneQuery() = default;
SceneQuery::SceneQuery(SceneQuery&& other) noexcept = default;
SceneQuery& SceneQuery::operator=(SceneQuery&& other) noexcept = default;

void SceneQuery::set_report(ReportHandle report) {
  state_->report = std::move(report);
}
const ReportHandle& SceneQuery::report() const {
  return state_->report;
}

std::size_t SceneQuery::cast_ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                 double limit, std::span<RayHit> room, const QueryFilter& filter) {
  const FloatingPointScope scope;
  check_point(origin, "the origin of a ray");
  check_point(direction, "the direction of a ray");
  if ((direction.array() == 0).all()) throw Error("query: the direction of a ray is 0");
  check_distance(limit, "the limit of a ray", true);
  if (room.empty()) return 0;
  const FilteredObjects objects(state_->geometry(), filter);
  const Ray ray{origin, direction, Eigen::Vector3d::Zero(), limit};
  const RayBoxTest test(ray);
  HitsOfRay hits(room, objects, limit);
  objects.visit([&](const Box& box) { return test.entry(box, hits.limit()); }, [&] { return hits.limit(); },
                [&](const KeptObject& object, const Surface& surface) {
                  hits.begin(object.id);
                  graze::cast_ray(ray, surface, object.groups.get(), hits);
                });
  for (RayHit& hit : hits.hits()) {
    hit.point = origin + hit.t * direction;
    hit.normal =
        triangle_normal(state_->geometry()->find(hit.object)->surface->surface, {hit.face, hit.triangle});
  }
  return hits.hits().size();
}

std::optional<RayHit> SceneQuery::cast_ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                           double limit, const QueryFilter& filter) {
  if (cast_ray(origin, direction, limit, state_->ray_hit, filter) == 0) return std::nullopt;
  return state_->ray_hit[0];
}

std::size_t SceneQuery::cast_sphere(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                                    std::span<SphereHit> room, const QueryFilter& filter) {
  const FloatingPointScope scope;
  check_point(from, "the start of a sphere");
  check_point(to, "the end of a sphere");
  check_distance(radius, "the radius of a sphere", false);
  if (room.empty()) return 0;
  const FilteredObjects objects(state_->geometry(), filter);
  const SphereSweep sweep{from, to, radius};
  const RayBoxTest test(Ray{from, to, from, 1});
  NearestRows hits(room, ByNumber<&SphereHit::t>(objects));
  const auto limit = [&] { return limit_of<&SphereHit::t>(hits, 1); };
  objects.visit([&](const Box& box) { return test.entry(grown(box, radius), limit()); }, limit,
                [&](const KeptObject& object, const Surface& surface) {
                  const auto touch = graze::cast_sphere(sweep, surface, object.groups.get(), limit());
                  if (!touch) return;
                  SphereHit hit;
                  hit.object = object.id;
                  hit.t = touch->t;
                  hits.add(hit);
                });
  for (SphereHit& hit : hits.rows()) {
    const KeptObject& object = *state_->geometry()->find(hit.object);
    hit.centre = sweep.centre(hit.t);
    const auto closest =
        state_->closest.find(hit.centre, object.surface->surface, object.groups.get(), endless);
    hit.point = closest->point_b;
    hit.normal = -closest->normal;
    hit.feature = closest->feature_b;
  }
  return hits.rows().size();
}

std::optional<SphereHit> SceneQuery::cast_sphere(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                 double radius, const QueryFilter& filter) {
  if (cast_sphere(from, to, radius, state_->sphere_hit, filter) == 0) return std::nullopt;
  return state_->sphere_hit[0];
}

std::size_t SceneQuery::closest_points(const Eigen::Vector3d& point, double limit,
                                       std::span<ClosestPoint> room, const QueryFilter& filter) {
  const FloatingPointScope scope;
  check_point(point, "the point");
  check_distance(limit, "the limit of a distance", true);
  if (room.empty()) return 0;
  const FilteredObjects objects(state_->geometry(), filter);
  Box at_point;
  at_point.add(point);
  NearestRows rows(room, ByNumber<&ClosestPoint::distance>(objects));
  const auto limit_now = [&] { return limit_of<&ClosestPoint::distance>(rows, limit); };
  objects.visit([&](const Box& box) { return lower_distance(at_point, box); }, limit_now,
                [&](const KeptObject& object, const Surface& surface) {
                  const auto found = state_->closest.find(point, surface, object.groups.get(), limit);
                  if (found)
                    rows.add({object.id, found->distance, found->point_b, -found->normal, found->feature_b,
                              found->side_b});
                });
  return rows.rows().size();
}

std::optional<ClosestPoint> SceneQuery::closest_point(const Eigen::Vector3d& point, double limit,
                                                      const QueryFilter& filter) {
  if (closest_points(point, limit, state_->closest_point, filter) == 0) return std::nullopt;
  return state_->closest_point[0];
}

std::size_t SceneQuery::blocking(MeshProbe& probe, double clearance, std::span<ObjectId> room,
                                 const QueryFilter& filter) {
  const FloatingPointScope scope;
  check_distance(clearance, "the clearance", false);
  const FilteredObjects objects(state_->geometry(), filter);
  const Box& around = probe.state_->surface.box();
  ListedObjects found(room, objects);
  objects.visit([&](const Box& box) { return lower_distance(around, box); }, [&] { return clearance; },
                [&](const KeptObject& object, const Surface& surface) {
                  if (probe.state_->is_blocked_by(surface, object.solid, object.groups.get(), clearance))
                    found.add(object.id);
                });
  return found.count();
}

bool SceneQuery::is_free(MeshProbe& probe, double clearance, const QueryFilter& filter) {
  const FloatingPointScope scope;
  check_distance(clearance, "the clearance", false);
  const FilteredObjects objects(state_->geometry(), filter);
  const Box& around = probe.state_->surface.box();
  bool is_blocked = false;
  objects.visit([&](const Box& box) { return lower_distance(around, box); },
                [&] { return is_blocked ? -1 : clearance; },
                [&](const KeptObject& object, const Surface& surface) {
                  is_blocked =
                      probe.state_->is_blocked_by(surface, object.solid, object.groups.get(), clearance);
                });
  return !is_blocked;
}

std::size_t SceneQuery::objects_in_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max,
                                       std::span<ObjectId> room, const QueryFilter& filter) {
  const FloatingPointScope scope;
  check_point(min, "the least corner of a box");
  check_point(max, "the largest corner of a box");
  if (!(min.array() <= max.array()).all()) throw Error("query: a box is empty");
  const FilteredObjects objects(state_->geometry(), filter);
  const Box wanted{min, max};
  ListedObjects found(room, objects);
  objects.visit([&](const Box& box) { return do_meet(wanted, box) ? 0 : endless; }, [] { return 0.0; },
                [&](const KeptObject& object, const Surface& surface) {
                  if (meets_box(wanted, surface, object.groups.get())) found.add(object.id);
                });
  return found.count();
}

}  // namespace graze
