// The soak of `graze_studies stress`, in which every few steps run out of memory somewhere. For minutes in
// place of some hundred frames: GRAZE_SOAK_MINUTES=10 in the environment.

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <new>

#include "scenes/random.hpp"
#include "scheduler/memory/failing_allocator.hpp"
#include "stress/soak/soak.hpp"
#include "support/catch.hpp"

namespace graze::tests {

TEST_CASE("memory failure: a soak in which steps run out of memory") {
  tools::SoakOptions options;
  if (const char* const minutes = std::getenv("GRAZE_SOAK_MINUTES"))
    options.minutes = std::strtod(minutes, nullptr);
  else
    options.frames = 400;
  scenes::Random random(29);
  options.begin_thread = [] { FailingAllocator::exempt_this_thread(); };
  options.step = [&](Scene& scene) {
    if (random.chance(0.7)) return scene.step();
    // Steps take little memory but after one that has failed, so that few first places are reached by most.
    const std::uint64_t place = random.below(std::size_t{1} << random.below(13));
    const auto lack =
        random.chance(0.5) ? FailingAllocator::Lack::once : FailingAllocator::Lack::from_then_on;
    ReportHandle report;
    FailingAllocator::begin(place, lack);
    try {
      report = scene.step();
    } catch (const std::bad_alloc&) {
      report = {};
    }
    (void)FailingAllocator::end();
    return report;
  };
  const tools::StressResult result = tools::run_soak_study(options);
  std::cout << result.figures.at("failed_steps") << " steps have thrown\n";
  for (const std::string& violation : result.violations) FAIL_CHECK(violation);
  CHECK(result.figures.at("failed_steps") > 20);
}

}  // namespace graze::tests
