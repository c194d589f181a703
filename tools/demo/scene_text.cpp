#include "scene_text.hpp"

#include "motions.hpp"

namespace graze::demo {

std::string scene_text(const std::string& character_file) {
  const std::string start = R"({
  "graze": 1,
  "contact_distance": 0.02,
  "range": 0.25,
  "detail": "features",
  "accuracy": "exact",
  "frames": )" + std::to_string(frame_count) +
                            R"(,
  "frames_per_second": 30,
  "objects": [
    {"name": "bull", "mesh": ")" +
                            character_file + R"(", "animation": "Wuson_Walk",
     "transform": {"rotate_degrees": [90, 0, 90]}},
)";
  return start + R"(    {"name": "ring", "mesh": "torus.obj", "positions": "torus.pc2"},
    {"name": "jelly", "mesh": "tooth.obj", "positions": "tooth_####.ply"},
    {"name": "pawn", "mesh": "pawn.obj", "layer": 4, "transform": {"scale": 0.55},
     "poses": [
       {"frame": 0, "translate": [2.9, -0.05, 0.52]},
       {"frame": 45, "translate": [1.75, -0.05, 0.52]},
       {"frame": 60, "translate": [1.8, -0.05, 0.5], "rotate_degrees": [0, 30, 0]},
       {"frame": 80, "translate": [2.3, -0.15, 0.22], "rotate_degrees": [0, 90, 0]},
       {"frame": 119, "translate": [2.6, -0.6, 0.22], "rotate_degrees": [0, 90, -40]}]},
    {"name": "cylinder", "mesh": "cylinder.obj", "layer": 4, "transform": {"scale": 0.3},
     "poses": [
       {"frame": 0, "translate": [0.15, -1.6, 0.2], "rotate_degrees": [0, 90, 0]},
       {"frame": 30, "translate": [0.15, -1.05, 0.2], "rotate_degrees": [120, 90, 0]},
       {"frame": 60, "translate": [0.15, -0.5, 0.2], "rotate_degrees": [240, 90, 0]},
       {"frame": 90, "translate": [0.15, 0.3, 0.2], "rotate_degrees": [360, 90, 0]},
       {"frame": 119, "translate": [0.15, 1.1, 0.2], "rotate_degrees": [480, 90, 0]}]},
    {"name": "human", "mesh": "human.obj", "layer": 4, "transform": {"scale": 0.85, "rotate_degrees": [0, 0, 90]},
     "poses": [
       {"frame": 0, "translate": [-2.3, 0, 0.8]},
       {"frame": 55, "translate": [-1.19, 0, 0.8], "rotate_degrees": [0, 12, 90]},
       {"frame": 75, "translate": [-1.19, 0, 0.8], "rotate_degrees": [0, 12, 90]},
       {"frame": 119, "translate": [-2.1, 0, 0.8]}]},
    {"name": "ground", "mesh": "ground.obj", "motion": "fixed", "layer": 2, "collides_with": 1, "kind": 1,
     "transform": {"translate": [0.3, 0, -0.05]}}
  ],
  "rules": [{"kinds": [0, 1], "contact_distance": 0.01, "range": 0.05}],
  "ignore": [["ring", "ground"], ["jelly", "ground"]]
}
)";
}

}  // namespace graze::demo
