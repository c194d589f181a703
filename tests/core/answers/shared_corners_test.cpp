// Surfaces that share corners, sides and faces, the same bits of all of a double, in every detail about
// surfaces against brute force: what comparing corners answers is what exact arithmetic would.

#include <algorithm>
#include <iostream>

#include "core/comparison.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"
#include "support/reduce.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

constexpr std::uint64_t scene_count = repeats(10'000) / 16;

std::vector<std::uint32_t> used_vertices(const Shape& shape) {
  std::vector<std::uint32_t> used;
  for (const auto& face : shape.faces) used.insert(used.end(), face.begin(), face.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

/// A surface on another: some faces are copies, turned or reversed. Other corners are corners of the other,
/// rounded middles of two, or anywhere.
Shape laid_on(const Shape& other, Random& random) {
  const std::vector<std::uint32_t> used = used_vertices(other);
  const auto any_corner = [&]() -> const Vector3d& {
    return other.positions[used[random.below(static_cast<std::uint32_t>(used.size()))]];
  };
  Shape shape;
  const auto add_corner = [&](const Vector3d& position) {
    shape.positions.push_back(position);
    return static_cast<std::uint32_t>(shape.positions.size() - 1);
  };
  for (std::uint32_t count = 1 + random.below(4); count > 0; --count) {
    std::vector<std::uint32_t> face;
    if (random.chance(0.5)) {
      const auto& copied = other.faces[random.below(static_cast<std::uint32_t>(other.faces.size()))];
      for (const std::uint32_t corner : copied) face.push_back(add_corner(other.positions[corner]));
      if (random.chance(0.5)) std::reverse(face.begin(), face.end());
      std::rotate(face.begin(), face.begin() + random.below(static_cast<std::uint32_t>(face.size())),
                  face.end());
    } else {
      for (std::uint32_t corners = 3 + random.below(2); corners > 0; --corners) {
        const Vector3d anywhere{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
        const Vector3d middle = 0.5 * (any_corner() + any_corner());
        face.push_back(add_corner(random.chance(0.6)   ? any_corner()
                                  : random.chance(0.5) ? middle
                                                       : anywhere));
      }
    }
    shape.faces.push_back(face);
  }
  return shape;
}

std::string answers_difference(const TwoShapes& scene) {
  return compare_surfaces(scene.a, scene.b, scene.threshold).difference;
}

}  // namespace

TEST_CASE("surfaces that share corners are those of brute force") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < scene_count; ++seed) {
    Random random(seed);
    const std::uint32_t corners = 4 + random.below(4);
    const Shape a = random_soup(2 * seed, corners, 1 + random.below(4));
    const Shape b = laid_on(a, random);
    const double threshold = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 0x1p-40 : 0.1;
    const Comparison comparison = compare_surfaces(a, b, threshold);
    if (!comparison.difference.empty())
      FAIL_CHECK("seed " << seed << ": " << comparison.difference << "reduced:\n"
                         << reduced_text({a, b, threshold}, answers_difference));
    contacts += comparison.contacts;
  }
  CHECK(contacts > 5 * scene_count);
  std::cout << "compared " << contacts << " contacts of surfaces that share corners\n";
}

}  // namespace graze::tests
