#include <array>
#include <cmath>
#include <graze/error.hpp>
#include <graze/scene_query.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/floating_point_scope.hpp"
#include "core/cast/box_overlap.hpp"
#include "core/cast/closest_point.hpp"
#include "core/cast/ray_cast.hpp"
#include "core/cast/sphere_cast.hpp"
#include "geometry/kept_geometry.hpp"
#include "geometry/mesh_probe.hpp"
#include "geometry/nearest_rows.hpp"

namespace graze {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

void check_point(const Eigen::Vector3d& point, const char* name) {
  if (!Surface::is_within_limits(point))
    throw Error(std::string("query: ") + name + " is not finite, or beyond 2^120");
}

/// A distance that is 0 or more, and finite unless `may_be_infinite`.
void check_distance(double distance, const char* name, bool may_be_infinite) {
  if (!(distance >= 0) || (!may_be_infinite && !(distance <= 0x1p120)))
    throw Error(std::string("query: ") + name + " is negative, not a number, or beyond 2^120");
}

/// The objects of a report that a filter leaves.
class FilteredObjects {
 public:
  FilteredObjects(const KeptGeometry* geometry, const QueryFilter& filter)
      : geometry_(geometry), filter_(filter) {}

  /// As KeptGeometry::visit_nearest_first.
  template <typename Lower, typename Limit, typename Use>
  void visit(const Lower& lower, const Limit& limit, const Use& use) const {
    if (geometry_ == nullptr) return;
    geometry_->visit_nearest_first(lower, limit, [&](const KeptObject& object) {
      const bool counts = (object.layer & filter_.collides_with) != 0 &&
                          (object.collides_with & filter_.layer) != 0 && object.id != filter_.ignored;
      if (counts) use(object, object.surface->surface);
    });
  }
  /// Ascends in the order in which objects were added.
  [[nodiscard]] std::uint64_t order_of(ObjectId id) const { return geometry_->find(id)->serial; }

 private:
  const KeptGeometry* geometry_;
  const QueryFilter& filter_;
};

/// Sorts rows of one number by it, then by their objects.
template <auto number>
class ByNumber {
 public:
  explicit ByNumber(const FilteredObjects& objects) : objects_(&objects) {}

  template <typename Row>
  bool operator()(const Row& left, const Row& right) const {
    if (left.*number != right.*number) return left.*number < right.*number;
    return left.object != right.object && objects_->order_of(left.object) < objects_->order_of(right.object);
  }

 private:
  const FilteredObjects* objects_;
};

/// Sorts hits of a ray by all that tells them apart.
class ByHit {
 public:
  explicit ByHit(const FilteredObjects& objects) : by_number_(objects) {}

  bool operator()(const RayHit& left, const RayHit& right) const {
    if (left.t != right.t || left.object != right.object) return by_number_(left, right);
    return left.feature < right.feature;
  }

 private:
  ByNumber<&RayHit::t> by_number_;
};

/// The number that rows of `rows` may have at most, to be among the first.
template <auto number, typename Row, typename IsBefore>
double limit_of(const NearestRows<Row, IsBefore>& rows, double limit) {
  return rows.is_full() ? rows.rows().back().*number : limit;
}

/// Takes hits of one object after the other.
class HitsOfRay final : public HitSink {
 public:
  HitsOfRay(std::span<RayHit> room, const FilteredObjects& objects, double limit)
      : hits_(room, ByHit(objects)), limit_(limit) {}

  [[nodiscard]] double limit() const override { return limit_of<&RayHit::t>(hits_, limit_); }
  void begin(ObjectId object) { object_ = object; }
  void take(const SurfaceHit& hit) override {
    RayHit row;
    row.object = object_;
    row.t = hit.t;
    row.feature = hit.feature;
    row.face = hit.triangle.face;
    row.triangle = hit.triangle.second;
    RayHit* const same = hits_.find(row);
    if (same == nullptr) return hits_.add(row);
    std::tie(same->face, same->triangle) =
        std::min(std::tuple(same->face, same->triangle), std::tuple(row.face, row.triangle));
  }
  [[nodiscard]] std::span<RayHit> hits() const { return hits_.rows(); }

 private:
  NearestRows<RayHit, ByHit> hits_;
  double limit_;
  ObjectId object_;
};

/// The first objects in the order of addition, in memory of the caller's, and how many there are.
class ListedObjects {
 public:
  ListedObjects(std::span<ObjectId> room, const FilteredObjects& objects)
      : objects_(room, IsBefore{&objects}) {}

  void add(ObjectId object) {
    ++count_;
    objects_.add(object);
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  struct IsBefore {
    const FilteredObjects* objects;
    bool operator()(ObjectId left, ObjectId right) const {
      return objects->order_of(left) < objects->order_of(right);
    }
  };

  NearestRows<ObjectId, IsBefore> objects_;
  std::size_t count_ = 0;
};

bool do_meet(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
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
  objects.visit(
      [&](const Box& box) { return box.empty() ? endless : test.entry(grown(box, radius), limit()); }, limit,
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
  objects.visit([&](const Box& box) { return box.empty() ? endless : lower_distance(at_point, box); },
                limit_now,
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
  objects.visit([&](const Box& box) { return box.empty() ? endless : lower_distance(around, box); },
                [&] { return clearance; },
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
  objects.visit([&](const Box& box) { return box.empty() ? endless : lower_distance(around, box); },
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
