#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/lock_free_pool.hpp"
#include "calls/calls.hpp"

namespace graze {

/// Calls from any number of threads to one that takes them up, without a lock: a stack, newest first, of
/// elements from a pool. Pushing is one exchange of the stack's head, which is the moment at which a call
/// takes its place in the order; taking empties the stack at once and turns it round.
class CallQueue {
 public:
  CallQueue() = default;
  CallQueue(const CallQueue&) = delete;
  CallQueue& operator=(const CallQueue&) = delete;

  /// Calls of one thread that enter the queue together, so that one step takes up all of them.
  class Chain {
   public:
    explicit Chain(CallQueue& queue) : queue_(queue) {}
    ~Chain() { push(); }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;

    /// Allocates where more calls wait than ever before, or were reserved. Where it throws nothing was added.
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
    /// Lets them in; else the end of the chain does.
    void push() noexcept {
      if (newest_ != none) queue_.push(std::exchange(newest_, none), oldest_);
    }

   private:
    CallQueue& queue_;
    std::uint32_t newest_ = none;
    std::uint32_t oldest_ = none;
  };

  /// Takes the calls that have entered out of the queue. One thread at a time.
  void collect() noexcept {
    // Acquire: the calls and their links were written before they were pushed (pushes are read-modify-writes,
    // which keep each other's release).
    const std::uint32_t newest = newest_.exchange(none, std::memory_order_acquire);
    if (newest == none) return;
    const std::uint32_t oldest = turned_round(newest);
    if (newest_collected_ == none)
      oldest_collected_ = oldest;
    else
      calls_.link(newest_collected_).store(oldest, std::memory_order_relaxed);
    newest_collected_ = newest;
  }
  /// Calls `visit` with each call taken and not yet visited, in their order, and forgets it. Where a visit
  /// throws, that call and those after it are the first of the next time. One thread at a time.
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

  /// Makes room for that many calls that wait at once.
  void reserve(std::size_t count) { calls_.reserve(count); }
  [[nodiscard]] std::size_t byte_count() const noexcept { return calls_.byte_count(); }

 private:
  static constexpr std::uint32_t none = LockFreePool<Call>::none;

  /// The calls that have been visited, from the first on; gives them back together when it goes.
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
    // Should the stack have been taken and pushed to meanwhile, `seen` is again its head and the link is
    // right: no tag is needed.
    do calls_.link(oldest).store(seen, std::memory_order_relaxed);
    while (
        !newest_.compare_exchange_weak(seen, newest, std::memory_order_release, std::memory_order_relaxed));
  }
  /// Links what is reached from `newest` the other way; returns the oldest.
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
  // A chain from the oldest to the newest: of the thread that takes.
  std::uint32_t oldest_collected_ = none;
  std::uint32_t newest_collected_ = none;
};

}  // namespace graze
