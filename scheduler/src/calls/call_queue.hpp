#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/lock_free_pool.hpp"
#include "calls/calls.hpp"

namespace graze {

/// A queue of calls from any number of threads to one thread, without a lock. It is a stack, newest first, of
/// elements of a pool. A push is one exchange of the stack's head, and that exchange decides the order of
/// calls. `collect` empties the stack at once and reverses it.
///
/// A thread pushes the calls 1 and 2, and another thread pushes 3 between them. Each links to the one before:
///
///     newest_ -> 2 -> 3 -> 1
///
/// `collect` takes all of them by one exchange of `newest_`, and turns the links round:
///
///     oldest_collected_ -> 1 -> 3 -> 2 <- newest_collected_
///
/// What is pushed after the exchange begins a new stack, which is for the next step.
class CallQueue {
 public:
  CallQueue() = default;
  CallQueue(const CallQueue&) = delete;
  CallQueue& operator=(const CallQueue&) = delete;

  /// Calls of one thread that enter the queue together, so that one step applies all of them.
  class Chain {
   public:
    explicit Chain(CallQueue& queue) : queue_(queue) {}
    ~Chain() { push(); }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;

    /// Adds a call. It allocates if more calls wait than ever before or than were reserved. If it throws,
    /// nothing was added.
    template <typename OneCall>
    void add(OneCall&& call) {
      const std::uint32_t added = queue_.calls_.acquire();
      queue_.calls_[added] = std::forward<OneCall>(call);
      if (newest_ == none)
        oldest_ = added;
      else
        queue_.calls_.link(added).store(newest_, std::memory_order_relaxed);
      newest_ = added;
    }
    /// Pushes the chain into the queue. The destructor does so otherwise.
    void push() noexcept {
      if (newest_ != none) queue_.push(std::exchange(newest_, none), oldest_);
    }

   private:
    CallQueue& queue_;
    std::uint32_t newest_ = none;
    std::uint32_t oldest_ = none;
  };

  /// Moves the calls that have entered out of the stack. One thread at a time.
  void collect() noexcept {
    // Acquire: calls and links were written before they were pushed. Pushes are read-modify-writes, which
    // continue each other's release sequence.
    const std::uint32_t newest = newest_.exchange(none, std::memory_order_acquire);
    if (newest == none) return;
    const std::uint32_t oldest = turned_round(newest);
    if (newest_collected_ == none)
      oldest_collected_ = oldest;
    else
      calls_.link(newest_collected_).store(oldest, std::memory_order_relaxed);
    newest_collected_ = newest;
  }
  /// Calls `visit` with each collected call in order, and forgets the call. If a visit throws, the next time
  /// begins with that call. One thread at a time.
  template <typename Visitor>
  void visit_collected(const Visitor& visit) {
    Visited visited(calls_, oldest_collected_);
    while (newest_collected_ != none) {
      const std::uint32_t call = oldest_collected_;
      std::visit(visit, calls_[call]);
      calls_[call] = RemoveObject{};
      visited.end_at(call);
      if (call == newest_collected_)
        newest_collected_ = none;
      else
        oldest_collected_ = calls_.link(call).load(std::memory_order_relaxed);
    }
  }

  /// Reserves memory for that many waiting calls.
  void reserve(std::size_t count) { calls_.reserve(count); }
  [[nodiscard]] std::size_t byte_count() const noexcept { return calls_.byte_count(); }

 private:
  static constexpr std::uint32_t none = LockFreePool<Call>::none;

  /// The calls visited so far. The destructor releases them together.
  class Visited {
   public:
    Visited(LockFreePool<Call>& calls, std::uint32_t first) : calls_(calls), first_(first) {}
    ~Visited() {
      if (last_ != none) calls_.release(first_, last_);
    }
    Visited(const Visited&) = delete;
    Visited& operator=(const Visited&) = delete;
    void end_at(std::uint32_t last) { last_ = last; }

   private:
    LockFreePool<Call>& calls_;
    std::uint32_t first_;
    std::uint32_t last_ = none;
  };

  void push(std::uint32_t newest, std::uint32_t oldest) noexcept {
    std::uint32_t seen = newest_.load(std::memory_order_relaxed);
    // The stack may be emptied and pushed to meanwhile. If `seen` is its head again, the link is still right,
    // so no tag is needed.
    do calls_.link(oldest).store(seen, std::memory_order_relaxed);
    while (
        !newest_.compare_exchange_weak(seen, newest, std::memory_order_release, std::memory_order_relaxed));
  }
  /// Reverses the chain that begins at `newest` and returns the oldest call.
  std::uint32_t turned_round(std::uint32_t newest) noexcept {
    std::uint32_t after = none;
    for (std::uint32_t call = newest; call != none;) {
      const std::uint32_t before = calls_.link(call).load(std::memory_order_relaxed);
      calls_.link(call).store(after, std::memory_order_relaxed);
      after = std::exchange(call, before);
    }
    return after;
  }

  LockFreePool<Call> calls_;
  std::atomic<std::uint32_t> newest_{none};
  // The collected chain, from the oldest call to the newest. Only the collecting thread uses it.
  std::uint32_t oldest_collected_ = none;
  std::uint32_t newest_collected_ = none;
};

}  // namespace graze
