#include "vertices/validate_near_part.hpp"

#ifdef GRAZE_VALIDATE
#include <algorithm>
#include <vector>

#include "core/base/require.hpp"
#include "core/surface/surface.hpp"

namespace graze {

void validate_near_part(const Surface& surface, const Box& box, double reach,
                        std::span<const std::uint32_t> listed) {
  require(surface.has_stretches(), "stretches are those of other positions", 0);
  std::vector<bool> is_listed(surface.mesh().vertex_count());
  for (const std::uint32_t vertex : listed) is_listed[vertex] = true;
  for (std::uint32_t vertex = 0; vertex < surface.mesh().vertex_count(); ++vertex) {
    const Eigen::Vector3d position = surface.position(vertex);
    const double outside = std::max((box.min - position).maxCoeff(), (position - box.max).maxCoeff());
    require(is_listed[vertex] || outside >= reach, "a vertex is near and not listed", vertex);
  }
}

}  // namespace graze
#else
namespace graze {
void validate_near_part(const Surface& /*surface*/, const Box& /*box*/, double /*reach*/,
                        std::span<const std::uint32_t> /*listed*/) {}
}  // namespace graze
#endif
