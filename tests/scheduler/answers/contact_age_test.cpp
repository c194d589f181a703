// The age of a contact against a record kept from the reports.

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <tuple>

#include "scheduler/moving_scene.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

using AgedKey = std::tuple<std::uint32_t, std::uint32_t, ContactKind, Feature, Feature>;

}  // namespace

static_assert(all_details.size() == 6, "add the number of a new detail to each list of numbers here");

TEMPLATE_TEST_CASE_SIG("age: the steps for which two features have been in contact, detail", "",
                       ((int number), number), 1, 2, 3, 4, 5) {
  const MovingScene moving;
  std::map<AgedKey, std::uint32_t> ages;
  std::uint32_t oldest = 0;
  std::size_t begun_again = 0;
  std::map<AgedKey, std::size_t> times_begun;
  moving.play(
      settings_of(0.05, 0.25, static_cast<ContactDetail>(number)), 40,
      [&](std::size_t, const ReportHandle& report, const std::vector<ObjectId>&) {
        std::map<AgedKey, std::uint32_t> now;
        for (const PairReport& pair : report->pairs())
          for (const Contact& contact : report->contacts(pair)) {
            const AgedKey key{pair.a.index, pair.b.index, contact.kind, contact.feature_a, contact.feature_b};
            const auto before = ages.find(key);
            now[key] = before == ages.end() ? 0 : before->second + 1;
            CHECK(report->age(contact) == now[key]);
            oldest = std::max(oldest, now[key]);
            if (now[key] == 0 && ++times_begun[key] > 1) ++begun_again;
          }
        ages.swap(now);
      });
  CHECK(oldest >= 1);
  if (number == static_cast<int>(ContactDetail::features)) CHECK(begun_again > 0);
  std::cout << "compared " << times_begun.size() << " contacts, the oldest " << oldest << " steps\n";
}

TEST_CASE("age: it goes on at rest, and while an object cannot be read") {
  const auto plate = plate_mesh();
  const auto needle = needle_mesh();
  Positions positions = lifted(*needle, 0.01);
  Scene scene(settings_of(0.1, 1));
  scene.add(plate);
  const ObjectId bound = scene.add(needle);
  scene.bind_positions(bound, PositionView(positions), BindPolicy::when_told);
  const auto age = [](const ReportHandle& report) {
    REQUIRE(report->contacts().size() == 1);
    return report->age(report->contacts()[0]);
  };
  std::uint64_t steps = 0;
  while (steps < 4) CHECK(age(scene.step()) == steps++);
  const double height = positions[0].z();
  positions[0].z() = std::numeric_limits<double>::quiet_NaN();
  scene.positions_changed(bound);
  while (steps < 7) CHECK(age(scene.step()) == steps++);
  positions[0].z() = height;
  CHECK(age(scene.step()) == 7);
  std::ranges::copy(lifted(*needle, 5), positions.begin());
  scene.positions_changed(bound);
  CHECK(scene.step()->contacts().empty());
  std::ranges::copy(lifted(*needle, 0.01), positions.begin());
  scene.positions_changed(bound);
  CHECK(age(scene.step()) == 0);
}

}  // namespace graze::tests
