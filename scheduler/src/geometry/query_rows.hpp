#pragma once

#include <algorithm>
#include <cstddef>
#include <graze/scene_query.hpp>
#include <limits>
#include <span>
#include <tuple>

#include "core/cast/ray_cast.hpp"
#include "geometry/kept_geometry.hpp"
#include "geometry/nearest_rows.hpp"

// The objects that a query asks, and the rows that it fills in memory of the caller's.

namespace graze {

inline constexpr double endless = std::numeric_limits<double>::infinity();

/// The objects of a report that a filter leaves.
class FilteredObjects {
 public:
  FilteredObjects(const KeptGeometry* geometry, const QueryFilter& filter)
      : geometry_(geometry), filter_(filter) {}

  /// As KeptGeometry::visit_nearest_first, by `use(object, surface)`. Empty boxes are passed over.
  template <typename Lower, typename Limit, typename Use>
  void visit(const Lower& lower, const Limit& limit, const Use& use) const {
    if (geometry_ == nullptr) return;
    const auto lower_of = [&](const Box& box) { return box.empty() ? endless : lower(box); };
    geometry_->visit_nearest_first(lower_of, limit, [&](const KeptObject& object) {
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

}  // namespace graze
