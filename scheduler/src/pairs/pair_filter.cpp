#include "pairs/pair_filter.hpp"

#include <algorithm>
#include <utility>

#include "core/pair/pair_query.hpp"

namespace graze {

PairFilter::PairFilter(const SceneSettings& settings) : settings_(settings) {
  const std::span<const double> epsilon(settings_.accuracy.epsilon());
  distances_.push_back({threshold_of(settings_.contact_distance, epsilon), settings_.range, epsilon});
  half_reaches_.fill(std::max(distances_[0].reach(), settings.swept_gap) / 2);
}

std::size_t PairFilter::index_of(std::uint32_t kind_a, std::uint32_t kind_b) {
  return std::size_t{kind_a} * kind_count + kind_b;
}

PairFilter::Distances PairFilter::distances_of(const PairRule& rule) const {
  std::span<const double> epsilon;
  if (settings_.accuracy.mode() == AccuracyMode::paper)
    epsilon = rule.epsilon.empty() ? std::span<const double>(settings_.accuracy.epsilon()) : rule.epsilon;
  return {threshold_of(rule.contact_distance.value_or(settings_.contact_distance), epsilon),
          rule.range.value_or(settings_.range), epsilon};
}

void PairFilter::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, PairRule rule) {
  ++rules_version_;
  if (rule_of_.empty()) rule_of_.assign(std::size_t{kind_count} * kind_count, 0);
  std::uint16_t& index = rule_of_[index_of(kind_a, kind_b)];
  if (index == 0) {
    distances_.reserve(distances_.size() + 1);  // rules are few; after both there is no more to throw
    rules_.emplace_back();
    distances_.emplace_back();
    index = rule_of_[index_of(kind_b, kind_a)] = static_cast<std::uint16_t>(rules_.size());
  }
  // The epsilons stay valid when rules move, since a vector keeps its memory when it is moved.
  rules_[index - std::size_t{1}] = std::move(rule);
  distances_[index] = distances_of(rules_[index - std::size_t{1}]);
  find_half_reach(kind_a);
  find_half_reach(kind_b);
}

/// Finds the half reach of a kind: half of its largest reach to any kind, or of the gap of sweeps. So the
/// half reaches of two kinds add up to at least their reach.
void PairFilter::find_half_reach(std::uint32_t kind) {
  double reach = settings_.swept_gap;
  for (std::uint32_t other = 0; other < kind_count; ++other)
    reach = std::max(reach, distances_of(kind, other).reach());
  half_reaches_[kind] = reach / 2;
}

void PairFilter::forget(Object& object) {
  if (!groups_.is_empty()) groups_.forget(object.serial);
  ignored_.forget(object);
}

PairVerdict PairFilter::verdict(const ObjectSummary& a, const ObjectSummary& b) const {
  // No filter of pairs takes out an object with itself, but all groups of its faces may be ignored.
  const PairVerdict lasting = a.serial == b.serial ? PairVerdict::tested : lasting_verdict(a, b);
  if (lasting != PairVerdict::tested || is_empty()) return lasting;
  return contains(std::minmax(a.serial, b.serial)) ? PairVerdict::ignored : PairVerdict::tested;
}

PairThresholds PairFilter::thresholds(const ObjectSummary& a, const ObjectSummary& b) const {
  const Distances& distances = distances_of(a.kind, b.kind);
  return {distances.contact + (a.margin + b.margin), reach(a, b), distances.epsilon};
}

std::size_t PairFilter::byte_count() const {
  return ignored_.byte_count() + groups_.byte_count() + changed_.byte_count() +
         rules_.capacity() * sizeof(PairRule) + distances_.capacity() * sizeof(Distances) +
         rule_of_.capacity() * sizeof(std::uint16_t);
}

}  // namespace graze
