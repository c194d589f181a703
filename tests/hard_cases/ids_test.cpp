// Ids over millions of adds and removes.

#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {

TEST_CASE("id reuse over millions of adds and removes: no id means two objects") {
  constexpr std::uint32_t count = 2'000'000;
  Scene scene(settings_of(0, 0, ContactDetail::none));
  const auto mesh = needle_mesh();
  oracle::Random random(1);
  std::vector<std::uint32_t> last_generation;  // by index
  std::vector<ObjectId> alive;
  std::size_t wrong = 0;
  for (std::uint32_t round = 0; round < count; ++round) {
    const ObjectId id = scene.add(mesh);
    if (id.index >= last_generation.size()) last_generation.resize(id.index + 1, 0);
    // An index is given again with a higher generation only: then no id is given twice.
    if (id.generation <= last_generation[id.index]) ++wrong;
    last_generation[id.index] = id.generation;
    alive.push_back(id);
    if (alive.size() > 8) {
      std::swap(alive[random.below(8)], alive.back());
      const ObjectId removed = alive.back();
      alive.pop_back();
      scene.remove(removed);
      if (scene.contains(removed)) ++wrong;
    }
    if (round % 1024 == 0) {
      const ReportHandle report = scene.step();
      if (!report->diagnostics().empty() || report->statistics().objects != alive.size()) ++wrong;
    }
  }
  CHECK(wrong == 0);
  CHECK(last_generation.size() < 4096);  // indices are used again
  for (const ObjectId id : alive) CHECK(scene.contains(id));
  std::cout << "compared " << count << " ids, of " << last_generation.size() << " indices\n";
}

}  // namespace graze::tests
