// The model of more processors: what steps of known rounds take.

#include "bench/scaling/scaling_model.hpp"

#include <utility>
#include <vector>

#include "support/catch.hpp"

namespace graze::tests {
namespace {

unsigned all_workers(double /*nanoseconds*/, unsigned most) {
  return most;
}
unsigned one_worker(double /*nanoseconds*/, unsigned /*most*/) {
  return 1;
}

constexpr bench::ThreadPrices free_threads{0, 0, 0, 0};

/// 100 before the round, its items, 50 after it.
bench::ModelStep step_of(std::vector<float> items) {
  bench::ModelStep step;
  step.rounds.push_back({100, 1e9, std::move(items), 0});
  step.length = 150 + step.rounds[0].sum();
  return step;
}

}  // namespace

TEST_CASE("scaling model: items go to the worker that is free first, and what is between rounds stays") {
  const bench::ModelStep step = step_of({400, 100, 100, 200, 100});
  CHECK(step.serial() == 150);
  const auto length = [&](unsigned threads, auto workers_worth) {
    return bench::predicted_length(step, threads, free_threads, workers_worth);
  };
  CHECK(length(1, all_workers) == 1050);
  CHECK(length(2, all_workers) == 150 + 500);  // 400 + 100 beside 100 + 100 + 200
  CHECK(length(3, all_workers) == 150 + 400);
  CHECK(length(64, all_workers) == 150 + 400);
  CHECK(length(64, one_worker) == 1050);
}

TEST_CASE("scaling model: rounds, threads that sleep and items of other threads have prices") {
  const bench::ModelStep step = step_of({1000, 1000, 1000, 1000});
  const auto length = [&](const bench::ThreadPrices& prices) {
    return bench::predicted_length(step, 4, prices, all_workers);
  };
  CHECK(length({7, 0, 0, 0}) == 150 + 7 + 1000);
  CHECK(length({0, 0, 0, 3}) == 150 + 1003);
  CHECK(length({0, 500, 0, 0}) == 150 + 1500);  // three others come late
  CHECK(length({0, 1e6, 0, 0}) == 150 + 4000);  // nobody comes in time
  // A thread that has just worked is awake.
  bench::ModelStep two = step;
  two.rounds.push_back({two.rounds[0].begin + 4000 + 10, 1e9, {1000, 1000, 1000, 1000}, 0});
  two.length = 150 + 8000 + 10;
  CHECK(bench::predicted_length(two, 4, {0, 500, 2000, 0}, all_workers) == 150 + 1500 + 10 + 1000);
}

}  // namespace graze::tests
