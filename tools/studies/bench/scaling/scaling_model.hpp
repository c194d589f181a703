#pragma once

#include <vector>

namespace graze::bench {

/// A round of tasks of a step that ran on one thread. Times are in nanoseconds.
struct ModelRound {
  double begin = 0;          ///< from the beginning of the step
  double estimate = 0;       ///< by which the scheduler decides how many workers it pays for
  std::vector<float> items;  ///< of each
  double rest = 0;           ///< of a worker that ends

  [[nodiscard]] double sum() const;
};

/// A step on one thread: rounds, and what lies between them.
struct ModelStep {
  double length = 0;
  std::vector<ModelRound> rounds;

  /// The time that is in no round.
  [[nodiscard]] double serial() const;
};

/// The prices of threads, in nanoseconds. The first three were measured on sixteen processors.
struct ThreadPrices {
  double round = 1'000;     ///< to begin a round with threads that are awake
  double wake = 60'000;     ///< until a thread comes that sleeps
  double awake = 30'000;    ///< how long a thread looks for work before it sleeps
  double moved_item = 150;  ///< an item whose memory another thread has written last
};

/// How long a step would take on so many processors, in nanoseconds. Each worker takes the next item as soon
/// as it is free. `workers_worth(estimate, threads)` says how many workers a round gets.
double predicted_length(const ModelStep& step, unsigned threads, const ThreadPrices& prices,
                        unsigned (*workers_worth)(double nanoseconds, unsigned most));

}  // namespace graze::bench
