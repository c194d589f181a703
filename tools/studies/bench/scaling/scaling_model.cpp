#include "bench/scaling/scaling_model.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace graze::bench {
namespace {

/// The threads of a machine as time goes on.
class Threads {
 public:
  Threads(unsigned count, const ThreadPrices& prices)
      : prices_(prices), last_work_(count, -prices.awake - 1), free_at_(count) {}

  /// Returns when a round ends that begins at `begin`.
  double round_end(const ModelRound& round, double begin, unsigned workers) {
    for (unsigned worker = 0; worker < workers; ++worker) {
      const bool sleeps = worker > 0 && begin - last_work_[worker] > prices_.awake;
      free_at_[worker] = begin + prices_.round + (sleeps ? prices_.wake : 0);
    }
    const auto last = free_at_.begin() + workers;
    // The earliest worker takes the next item. The calling thread does not wait for one that comes too late.
    double end = begin;
    for (const float item : round.items) {
      const auto earliest = std::min_element(free_at_.begin(), last);
      *earliest += item + prices_.moved_item;
      last_work_[static_cast<std::size_t>(earliest - free_at_.begin())] = *earliest;
      end = std::max(end, *earliest);
    }
    return end + round.rest;
  }
  void note_work(double at) { last_work_[0] = at; }

 private:
  const ThreadPrices& prices_;
  std::vector<double> last_work_;  ///< when each thread ended its last item
  std::vector<double> free_at_;
};

}  // namespace

double ModelRound::sum() const {
  return std::accumulate(items.begin(), items.end(), rest);
}

double ModelStep::serial() const {
  return std::accumulate(rounds.begin(), rounds.end(), length,
                         [](double left, const ModelRound& round) { return left - round.sum(); });
}

double predicted_length(const ModelStep& step, unsigned threads, const ThreadPrices& prices,
                        unsigned (*workers_worth)(double nanoseconds, unsigned most)) {
  Threads all(threads, prices);
  double now = 0;
  double recorded = 0;  // the same moment on one thread
  for (const ModelRound& round : step.rounds) {
    now += round.begin - recorded;
    recorded = round.begin + round.sum();
    const unsigned paid = workers_worth(round.estimate, threads);
    const auto workers = static_cast<unsigned>(std::min<std::size_t>(round.items.size(), paid));
    now = workers <= 1 ? now + round.sum() : all.round_end(round, now, workers);
    all.note_work(now);
  }
  return now + step.length - recorded;
}

}  // namespace graze::bench
