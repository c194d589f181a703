#include "core/cast/sphere_cast.hpp"

#include <tuple>

#include "cast/region_cast.hpp"
#include "cast/sphere_triangle.hpp"
#include "cast/triangles.hpp"

namespace graze {
namespace {

/// The first touch of the triangles that were offered.
class FirstTouch {
 public:
  FirstTouch(const SphereSweep& sweep, const Ray& way, double limit)
      : sweep_(sweep), box_test_(way), limit_(limit) {}

  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] const std::optional<SphereTouch>& found() const { return found_; }

  void offer(const Surface& surface, const TriangleOfFace& triangle) {
    const auto corner = corners_of(surface, triangle);
    if (box_test_.entry(grown(box_of(corner), sweep_.radius), limit_) == RayBoxTest::miss) return;
    const auto t = touch_time(sweep_, corner, limit_);
    if (!t || (found_ && order(*t, triangle) > order(found_->t, found_->triangle))) return;
    if (!ever_touches(sweep_, corner, count_)) return;
    found_ = SphereTouch{*t, triangle};
    limit_ = *t;
  }

 private:
  static std::tuple<double, std::uint32_t, std::uint8_t> order(double t, const TriangleOfFace& triangle) {
    return {t, triangle.face, triangle.second};
  }

  const SphereSweep& sweep_;
  const RayBoxTest box_test_;
  double limit_;
  DecisionCount count_;
  std::optional<SphereTouch> found_;
};

}  // namespace

std::optional<SphereTouch> cast_sphere(const SphereSweep& sweep, const Surface& surface,
                                       const FaceGroups* groups, double limit) {
  const Ray way{sweep.from, sweep.to, sweep.from, 1};
  FirstTouch first(sweep, way, std::min(limit, 1.0));
  visit_leaves_along(
      way, surface, sweep.radius, [&] { return first.limit(); },
      [&](const Region& leaf) {
        visit_triangles(surface, leaf, groups,
                        [&](const TriangleOfFace& triangle) { first.offer(surface, triangle); });
      });
  return first.found();
}

}  // namespace graze
