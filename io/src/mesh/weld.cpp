#include "mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace graze::io {
namespace {

/// Adding zero makes -0 into 0. Two NaN are equal when their bits are.
std::uint64_t bits_of(double number) {
  return std::bit_cast<std::uint64_t>(number + 0.0);
}

bool same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return bits_of(a.x()) == bits_of(b.x()) && bits_of(a.y()) == bits_of(b.y()) &&
         bits_of(a.z()) == bits_of(b.z());
}

std::uint64_t hash_of(const Eigen::Vector3d& position) {
  std::uint64_t hash = 0;
  for (const double number : {position.x(), position.y(), position.z()})
    hash = std::rotl((hash ^ bits_of(number)) * 0x9e3779b97f4a7c15U, 29);
  return hash;
}

/// The hash of all that makes two vertices one. Vertices of one place may differ in their influences alone.
std::uint64_t hash_of(const Body& body, std::uint32_t vertex) {
  std::uint64_t hash = hash_of(body.vertices[vertex]);
  const auto add = [&](std::uint64_t bits) { hash = std::rotl((hash ^ bits) * 0x9e3779b97f4a7c15U, 29); };
  if (!body.influences.empty())
    for (const Influence& influence : body.influences[vertex]) {
      add(influence.bone);
      add(bits_of(influence.weight));
    }
  for (const MorphTarget& target : body.targets) add(hash_of(target.offsets[vertex]));
  return hash;
}

bool same_vertex(const Body& body, std::uint32_t a, std::uint32_t b) {
  if (!same(body.vertices[a], body.vertices[b])) return false;
  if (!body.influences.empty() && body.influences[a] != body.influences[b]) return false;
  return std::all_of(body.targets.begin(), body.targets.end(),
                     [&](const MorphTarget& target) { return same(target.offsets[a], target.offsets[b]); });
}

template <typename T>
void keep_only(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] != i) values[i] = std::move(values[kept[i]]);
  values.resize(kept.size());
}

}  // namespace

std::vector<std::uint32_t> weld(Body& body) {
  std::unordered_multimap<std::uint64_t, std::uint32_t> new_by_hash;
  std::vector<std::uint32_t> kept;
  std::vector<std::uint32_t> new_number;
  new_number.reserve(body.vertices.size());
  for (std::uint32_t vertex = 0; vertex < body.vertices.size(); ++vertex) {
    const std::uint64_t hash = hash_of(body, vertex);
    const auto [begin, end] = new_by_hash.equal_range(hash);
    const auto equal = std::find_if(
        begin, end, [&](const auto& entry) { return same_vertex(body, kept[entry.second], vertex); });
    if (equal != end) {
      new_number.push_back(equal->second);
      continue;
    }
    const auto number = static_cast<std::uint32_t>(kept.size());
    new_number.push_back(number);
    kept.push_back(vertex);
    new_by_hash.emplace(hash, number);
  }
  keep_only(body.vertices, kept);
  if (!body.influences.empty()) keep_only(body.influences, kept);
  for (auto& target : body.targets) keep_only(target.offsets, kept);
  return new_number;
}

}  // namespace graze::io
