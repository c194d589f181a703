#include "ignored.hpp"

#include <algorithm>

#include "borders.hpp"

namespace graze::cluster {
namespace {

/// The object of a number. The filter notes in it what is ignored.
Object* object_of(Number number, const ObjectStore& store) {
  const Object* const object = store.find_serial(number);
  return object == nullptr ? nullptr : store.find(object->id);
}

bool is_own(Number number, const ObjectStore& store) {
  const Object* const object = store.find_serial(number);
  return object != nullptr && !is_ghost(*object);
}

/// The call with the lower number first.
Ignored::Call in_order(Ignored::Call call) {
  if (call.b < call.a) {
    std::swap(call.a, call.b);
    if (call.groups) std::swap((*call.groups)[0], (*call.groups)[1]);
  }
  // The order of two groups of one object does not matter.
  if (call.b == call.a && call.groups) std::sort(call.groups->begin(), call.groups->end());
  return call;
}

}  // namespace

void Ignored::add(const Call& call) {
  const std::lock_guard lock(mutex_);
  calls_.push_back(in_order(call));
}

void Ignored::take_up(const ObjectStore& store, PairFilter& filter) {
  std::vector<Call> calls;
  {
    const std::lock_guard lock(mutex_);
    calls.swap(calls_);
  }
  for (const Call& call : calls) {
    if (!is_own(call.a, store) && !is_own(call.b, store)) continue;
    learn(call);
    Object* const a = object_of(call.a, store);
    Object* const b = object_of(call.b, store);
    if (a == nullptr || b == nullptr) continue;
    if (call.groups)
      filter.set_ignored(*a, (*call.groups)[0], *b, (*call.groups)[1], call.ignored);
    else if (a != b)
      filter.set_ignored(*a, *b, call.ignored);
  }
}

void Ignored::learn(const Call& call) {
  const Pair pair(call.a, call.b);
  Known& known = known_[pair];
  if (!call.groups)
    known.whole = call.ignored;
  else if (call.ignored)
    known.groups.insert(*call.groups);
  else
    known.groups.erase(*call.groups);
  if (known.whole || !known.groups.empty()) {
    partners_[call.a].insert(call.b);
    partners_[call.b].insert(call.a);
    return;
  }
  known_.erase(pair);
  for (const auto& [one, other] : {pair, Pair(call.b, call.a)})
    if (const auto found = partners_.find(one); found != partners_.end()) {
      found->second.erase(other);
      if (found->second.empty()) partners_.erase(found);
    }
}

void Ignored::apply(const Pair& pair, const Known& known, const ObjectStore& store, PairFilter& filter) {
  Object* const a = object_of(pair.first, store);
  Object* const b = object_of(pair.second, store);
  if (a == nullptr || b == nullptr) return;
  if (known.whole && a != b) filter.set_ignored(*a, *b, true);
  for (const auto& [group_a, group_b] : known.groups) filter.set_ignored(*a, group_a, *b, group_b, true);
}

void Ignored::apply_to(Number number, const ObjectStore& store, PairFilter& filter) const {
  const auto found = partners_.find(number);
  if (found == partners_.end()) return;
  for (const Number other : found->second) {
    const Pair pair = std::minmax(number, other);
    apply(pair, known_.at(pair), store, filter);
  }
}

void Ignored::forget(Number number) {
  for (const Call& call : of(number)) undo(call);
}

std::vector<Ignored::Call> Ignored::of(Number number) const {
  std::vector<Call> calls;
  const auto found = partners_.find(number);
  if (found == partners_.end()) return calls;
  for (const Number other : found->second) {
    const Pair pair = std::minmax(number, other);
    const Known& known = known_.at(pair);
    if (known.whole) calls.push_back({pair.first, pair.second, {}, true});
    for (const Groups& groups : known.groups) calls.push_back({pair.first, pair.second, groups, true});
  }
  return calls;
}

}  // namespace graze::cluster
