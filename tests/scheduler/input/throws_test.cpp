// The few calls that throw: constructors, add, and a second step at once.

#include <atomic>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void check_refused(const SceneSettings& settings, const std::string& word) {
  try {
    const Scene scene(settings);
    FAIL("taken: " << word);
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Catch::Matchers::Contains(word));
  }
}

void check_refused(const ObjectSettings& settings, const std::string& word) {
  Scene scene(settings_of(0.5, 1));
  try {
    scene.add(plate_mesh(), settings);
    FAIL("taken: " << word);
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Catch::Matchers::Contains(word));
    CHECK_THAT(error.what(), Catch::Matchers::Contains(settings.name));
  }
  CHECK(scene.object_count() == 0);
  CHECK(scene.step()->diagnostics().empty());
}

}  // namespace

TEST_CASE("a scene with bad settings is refused") {
  for (const double bad : {-1.0, nothing, infinity}) check_refused(settings_of(bad, 1), "contact_distance");
  for (const double bad : {-1.0, nothing}) check_refused(settings_of(0, bad), "range");
  for (const ContactDetail detail : surface_details) {
    SceneSettings settings = settings_of(0.1, 1, detail);
    settings.accuracy = Accuracy::paper({1, 0.5});
    check_refused(settings, "paper");
    settings.accuracy = Accuracy::paper();
    check_refused(settings, "paper");
  }
  for (const ContactDetail detail : {ContactDetail::regions, ContactDetail::vertices}) {
    SceneSettings settings = settings_of(0.1, 1, detail);
    settings.accuracy = Accuracy::paper();
    CHECK_NOTHROW(Scene(settings));
  }
}

TEST_CASE("numbers that are no enumerators are refused") {
  SceneSettings settings = settings_of(0.1, 1);
  settings.detail = static_cast<ContactDetail>(77);
  check_refused(settings, "detail is 77");
  settings.detail = ContactDetail::none;
  settings.arena = static_cast<ArenaPolicy>(2);
  check_refused(settings, "arena is 2");
  ObjectSettings object;
  object.motion = static_cast<Motion>(3);
  check_refused(object, "motion is 3");
}

TEST_CASE("a message shows a small number as it is") {
  check_refused(settings_of(-1e-9, 1), "-1e-09");
  ObjectSettings object;
  object.margin = -2.5e-7;
  check_refused(object, "-2.5e-07");
}

TEST_CASE("accuracies of bad numbers are refused") {
  CHECK_THROWS_AS(Accuracy::within(-1), Error);
  CHECK_THROWS_AS(Accuracy::within(nothing), Error);
  CHECK_THROWS_AS(Accuracy::within(infinity), Error);
  CHECK_THROWS_AS(Accuracy::paper({1, -1}), Error);
  CHECK_THROWS_AS(Accuracy::paper({nothing}), Error);
}

TEST_CASE("an object without mesh or with bad settings is refused, and the scene goes on") {
  ObjectSettings settings;
  settings.name = "Jonas";
  for (const double bad : {-1.0, nothing, infinity}) {
    settings.margin = bad;
    check_refused(settings, "margin");
  }
  settings.margin = 0;
  settings.kind = 256;
  check_refused(settings, "kind");
  Scene scene(settings_of(0.5, 1));
  CHECK_THROWS_AS(scene.add(nullptr), Error);
  CHECK(scene.object_count() == 0);
}

// Both threads step without a pause until one is refused, so that one must come in while the other steps.
TEST_CASE("a second step at the same time is refused and disturbs nothing") {
  SceneSettings settings = settings_of(0.05, 1);
  Scene scene(settings);
  const auto torus = mesh_of(models::torus(24, 12, 1, 0.25));
  for (int i = 0; i < 3; ++i) scene.set_positions(scene.add(torus), lifted(*torus, 0.45 * i));
  std::atomic<bool> refused = false;
  std::atomic<std::uint64_t> done = 0;
  std::string message;
  const auto step_until_refused = [&] {
    while (!refused && done < 100000) {
      try {
        scene.step();
        ++done;
      } catch (const Error& error) {
        if (!refused.exchange(true)) message = error.what();
      }
    }
  };
  std::thread other(step_until_refused);
  step_until_refused();
  other.join();
  CHECK(refused);
  CHECK_THAT(message, Catch::Matchers::Contains("step"));
  CHECK(scene.latest_report()->frame() == done);
  CHECK(scene.step()->frame() == done + 1);
}

}  // namespace graze::tests
