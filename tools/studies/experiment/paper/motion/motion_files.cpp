#include "experiment/paper/motion/motion_files.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "demo/writers.hpp"

namespace graze::tools {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::vector<Eigen::Vector3d>> points_of(const RecordedObject& object) {
  std::vector<std::vector<Eigen::Vector3d>> frames(object.frames.size());
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    for (std::size_t i = 0; i < object.positions(frame).size(); ++i)
      frames[frame].push_back(object.positions(frame)[i]);
  return frames;
}

Json objects_of(const RecordedMotion& motion) {
  Json objects = Json::array();
  for (const RecordedObject& object : motion.objects)
    objects.push_back({{"name", object.name},
                       {"mesh", object.name + ".ply"},
                       {"positions", object.name + ".pc2"},
                       {"kind", object.kind_id},
                       {"group", object.group}});
  return objects;
}

Json scene_of(const RecordedMotion& motion, double contact_distance) {
  return {{"graze", 1},
          {"contact_distance", contact_distance},
          {"range", "infinity"},
          {"detail", "regions"},
          {"accuracy", "exact"},
          {"frames", motion.frame_count()},
          {"objects", objects_of(motion)}};
}

Json rules_of(const PaperRow& row) {
  Json rules = Json::array();
  for (const RowRule& rule : row.rules)
    rules.push_back(
        {{"kinds", rule.kinds}, {"contact_distance", rule.epsilon.back()}, {"epsilon", rule.epsilon}});
  return rules;
}

}  // namespace

void write_motion(const std::filesystem::path& folder, const RecordedMotion& motion,
                  const std::vector<PaperRow>& rows) {
  std::filesystem::create_directories(folder);
  for (const RecordedObject& object : motion.objects) {
    demo::write_ply(folder / (object.name + ".ply"), object.rest);
    demo::write_pc2(folder / (object.name + ".pc2"), points_of(object));
  }
  demo::write_text(folder / "exact.json", scene_of(motion, rows[best_row].last()).dump(1) + "\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Json scene = scene_of(motion, rows[i].last());
    scene["accuracy"] = {{"paper", rows[i].rules[0].epsilon}};
    scene["rules"] = rules_of(rows[i]);
    demo::write_text(folder / ("row_" + std::to_string(i + 1) + ".json"), scene.dump(1) + "\n");
  }
}

}  // namespace graze::tools
