#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "arithmetic/arithmetic.hpp"
#include "core/pair/pair_query.hpp"

namespace graze {

/// Thrown when the time of a query is up, and caught where the search was called. Whatever is remembered of a
/// pair is true wherever it is thrown, and every query begins its working memory anew.
struct TimeIsUp {};

/// The deadline of a query, seen by one thread. A check of the clock costs some 25 ns. It is made often
/// enough that a search ends some tens of microseconds after its deadline.
class TimeLimit {
 public:
  using Clock = std::chrono::steady_clock;

  TimeLimit(Clock::time_point deadline, const DecisionCount& count) : deadline_(deadline), count_(count) {}

  [[nodiscard]] bool is_set() const { return deadline_ != PairQuery::no_deadline; }
  /// To be called before so many pieces of work of some hundred nanoseconds each. Throws TimeIsUp.
  void check(std::uint32_t pieces = 1) {
    // A question that double could not decide may take as long as many pieces.
    constexpr std::uint32_t pieces_a_check = 32;
    pieces_ += pieces;
    if (pieces_ < pieces_a_check && count_.exact == exact_seen_) return;
    pieces_ = 0;
    exact_seen_ = count_.exact;
    check_for({});
  }
  /// To be called before work that takes at least so long. Throws TimeIsUp where that is not left.
  void check_for(std::chrono::nanoseconds needed) const {
    if (is_set() && Clock::now() + needed >= deadline_) throw TimeIsUp{};
  }
  [[nodiscard]] std::chrono::nanoseconds left() const {
    return std::max<std::chrono::nanoseconds>(deadline_ - Clock::now(), std::chrono::nanoseconds(0));
  }
  void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }

 private:
  Clock::time_point deadline_;
  const DecisionCount& count_;
  std::uint32_t pieces_ = ~std::uint32_t{0} / 2;  ///< since the last check, of which there was none yet
  std::uint64_t exact_seen_ = 0;
};

}  // namespace graze
