#include "experiment/paper/region_escapes.hpp"

#include <map>
#include <utility>

#include "core/mesh/indexed_mesh.hpp"
#include "experiment/paper/paper_walk.hpp"

namespace graze::tools {
namespace {

void count_object(const RecordedObject& object, std::size_t frame, const PlacedObject& first,
                  std::vector<EscapeCount>& levels) {
  const PositionView now = object.positions(frame);
  const RegionTree& tree = indexed(*object.mesh).regions();
  for (std::uint32_t index = 1; index < tree.region_count(); ++index) {
    const Region& region = tree.region(index);
    EscapeCount& count = levels[region.level - 1];
    const double own = first.radii()[index];
    const double level = first.level_radii()[region.level];
    for (const std::uint32_t vertex : tree.vertices(region)) {
      const double distance = (now[vertex] - now[region.middle]).norm();
      ++count.vertices;
      count.outside_own += distance > own ? 1U : 0U;
      count.outside_level += distance > level ? 1U : 0U;
      if (own > 0) count.furthest = std::max(count.furthest, distance / own);
    }
  }
}

}  // namespace

std::vector<EscapeCount> count_escapes(const RecordedMotion& motion) {
  std::vector<std::string> kinds;
  std::map<std::string, std::vector<EscapeCount>> counts;
  for (const RecordedObject& object : motion.objects) {
    const PlacedObject first(object, 0);
    if (!counts.contains(object.kind)) kinds.push_back(object.kind);
    std::vector<EscapeCount>& levels = counts[object.kind];
    for (std::uint32_t level = 1; level < indexed(*object.mesh).regions().level_count(); ++level) {
      if (levels.size() < level) levels.push_back({.kind = object.kind, .level = level});
      levels[level - 1].epsilon = std::max(levels[level - 1].epsilon, first.level_radii()[level]);
    }
    for (std::size_t frame = 1; frame < motion.frame_count(); ++frame)
      count_object(object, frame, first, levels);
  }
  std::vector<EscapeCount> all;
  for (const std::string& kind : kinds) all.insert(all.end(), counts[kind].begin(), counts[kind].end());
  return all;
}

}  // namespace graze::tools
