#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>

#include "core/cast/ray.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A triangle of a surface: that of the first three corners of a face, or the second one of a quad.
struct TriangleOfFace {
  std::uint32_t face = 0;
  std::uint8_t second = 0;  ///< 1 for a quad's second triangle, of the corners 0, 2 and 3
};

/// A point that a ray and a surface share.
struct SurfaceHit {
  double t = 0;     ///< correctly rounded
  Feature feature;  ///< in whose inside the point lies. The diagonal of a quad counts as its face
  TriangleOfFace triangle;
};

/// Takes what a ray meets.
class HitSink {
 public:
  virtual ~HitSink() = default;
  /// No hit with a larger t is asked for any more.
  [[nodiscard]] virtual double limit() const = 0;
  virtual void take(const SurfaceHit& hit) = 0;
};

/// Offers the first point that a ray shares with each triangle, in no order. So a point on an edge comes once
/// for each triangle there, with equal numbers. Hits beyond the sink's limit may be left out. Faces that
/// `groups` hides are not met. A null pointer hides none. The surface has been refitted for faces now.
GRAZE_API void cast_ray(const Ray& ray, const Surface& surface, const FaceGroups* groups, HitSink& sink);

/// The unit normal of a triangle by its winding, within some 2^-44. It is 0 for one without area.
GRAZE_API Eigen::Vector3d triangle_normal(const Surface& surface, const TriangleOfFace& triangle);

}  // namespace graze
