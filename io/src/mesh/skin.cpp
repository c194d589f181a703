#include "mesh/skin.hpp"

#include <algorithm>

#include "mesh/used_vertices.hpp"

namespace graze::io {
namespace {

void join_equal_bones(std::vector<Influence>& influences) {
  std::ranges::stable_sort(influences, {}, &Influence::bone);
  std::size_t count = 0;
  for (const Influence& influence : influences) {
    if (count > 0 && influences[count - 1].bone == influence.bone)
      influences[count - 1].weight += influence.weight;
    else
      influences[count++] = influence;
  }
  influences.resize(count);
}

}  // namespace

void set_bones(Body& body, const std::vector<Bone>& joints) {
  std::vector<std::uint32_t> named;
  for (auto& influences : body.influences) {
    join_equal_bones(influences);
    for (const Influence& influence : influences) named.push_back(influence.bone);
  }
  const UsedVertices used(named, joints.size());
  body.bones.clear();
  for (const std::uint32_t joint : used.old_numbers()) body.bones.push_back(joints[joint]);
  for (auto& influences : body.influences)
    for (Influence& influence : influences) influence.bone = used.new_number(influence.bone);
  if (body.bones.empty()) body.influences.clear();
}

}  // namespace graze::io
