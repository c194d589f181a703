#include "replay/known_filters.hpp"

#include <algorithm>

namespace graze {
namespace {

/// Puts a value into a set, or takes it out.
template <typename Value>
void put(std::set<Value>& set, const Value& value, bool is_in) {
  if (is_in)
    set.insert(value);
  else
    set.erase(value);
}

bool is_empty(const PairRule& rule) {
  return !rule.contact_distance && !rule.range && rule.epsilon.empty();
}

}  // namespace

void KnownFilters::take(const IgnorePair& call) {
  all_.reset();
  put(ignored_, std::pair<ObjectId, ObjectId>(std::minmax(call.a, call.b)), call.ignored);
}

void KnownFilters::take(const IgnoreGroups& call) {
  all_.reset();
  const FaceGroup a{call.a, call.group_a};
  const FaceGroup b{call.b, call.group_b};
  put(ignored_groups_, std::pair<FaceGroup, FaceGroup>(std::minmax(a, b)), call.ignored);
}

void KnownFilters::take(const SetRule& call) {
  all_.reset();
  const std::pair<std::uint32_t, std::uint32_t> kinds = std::minmax(call.kind_a, call.kind_b);
  if (is_empty(call.rule))
    rules_.erase(kinds);
  else
    rules_[kinds] = call.rule;
}

void KnownFilters::forget(ObjectId object) {
  const auto erased = std::erase_if(
      ignored_, [&](const auto& pair) { return pair.first == object || pair.second == object; });
  const auto groups_erased = std::erase_if(ignored_groups_, [&](const auto& groups) {
    return groups.first.object == object || groups.second.object == object;
  });
  if (erased + groups_erased > 0) all_.reset();
}

std::shared_ptr<const PairFilters> KnownFilters::all() {
  if (all_) return all_;
  const auto all = std::make_shared<PairFilters>();
  all->ignored.assign(ignored_.begin(), ignored_.end());
  all->ignored_groups.assign(ignored_groups_.begin(), ignored_groups_.end());
  for (const auto& [kinds, rule] : rules_) all->rules.push_back({kinds.first, kinds.second, rule});
  return all_ = all;
}

}  // namespace graze
