#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "messages.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"

namespace graze::cluster {

/// The pairs that calls have taken out. The rank of each object knows them, and so it does before the other
/// object comes near. Stepping thread only, but for `add`.
class Ignored {
 public:
  using Groups = std::array<std::uint8_t, 2>;
  /// A call about a pair: about two groups of faces, or about all of it.
  struct Call {
    Number a = 0;
    Number b = 0;
    std::optional<Groups> groups;
    bool ignored = true;
  };

  /// Keeps a call for the next step. Any thread.
  void add(const Call& call);

  /// Takes up the calls that were added, and gives them to the filter where both objects are there.
  void take_up(const ObjectStore& store, PairFilter& filter);
  /// Gives the filter what is known of an object that has come.
  void apply_to(Number number, const ObjectStore& store, PairFilter& filter) const;
  /// Forgets an object that was removed for good.
  void forget(Number number);
  /// Forgets an object that goes to another rank, but for what concerns objects that stay: `stays(number)`.
  template <typename Stays>
  void leave(Number number, const Stays& stays) {
    for (const Call& call : of(number))
      if (!stays(call.a == number ? call.b : call.a)) undo(call);
  }

  /// The calls that make all that is known of an object.
  [[nodiscard]] std::vector<Call> of(Number number) const;
  /// Takes up a call that another rank knew.
  void learn(const Call& call);

 private:
  struct Known {
    bool whole = false;
    std::set<Groups> groups;  ///< of the lower number first
  };
  using Pair = std::pair<Number, Number>;

  void undo(Call call) {
    call.ignored = false;
    learn(call);
  }
  static void apply(const Pair& pair, const Known& known, const ObjectStore& store, PairFilter& filter);

  std::mutex mutex_;
  std::vector<Call> calls_;
  std::map<Pair, Known> known_;  ///< the lower number first
  std::map<Number, std::set<Number>> partners_;
};

template <Is<Ignored::Call> T>
auto fields(T& r) {
  return std::tie(r.a, r.b, r.groups, r.ignored);
}

}  // namespace graze::cluster
