#include "pairs/pair_filter.hpp"

#include <algorithm>
#include <utility>

namespace graze {
namespace {

/// The threshold of DV: the last of the paper's epsilons if there are any, otherwise the contact distance.
double base_distance(double contact_distance, std::span<const double> epsilon) {
  return epsilon.empty() ? contact_distance : epsilon.back();
}

PairSet::Pair serials_of(const Object& a, const Object& b) {
  return std::minmax(a.serial, b.serial);
}

}  // namespace

PairFilter::PairFilter(const SceneSettings& settings) : settings_(settings) {
  const std::span<const double> epsilon(settings_.accuracy.epsilon());
  distances_.push_back({base_distance(settings_.contact_distance, epsilon), settings_.range, epsilon});
  half_reaches_.fill(distances_[0].reach() / 2);
}

std::size_t PairFilter::index_of(std::uint32_t kind_a, std::uint32_t kind_b) {
  return std::size_t{kind_a} * kind_count + kind_b;
}

PairFilter::Distances PairFilter::distances_of(const PairRule& rule) const {
  std::span<const double> epsilon;
  if (settings_.accuracy.mode() == AccuracyMode::paper)
    epsilon = rule.epsilon.empty() ? std::span<const double>(settings_.accuracy.epsilon()) : rule.epsilon;
  return {base_distance(rule.contact_distance, epsilon), rule.range, epsilon};
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

/// Finds the half reach of a kind: half of its largest reach to any kind. So the half reaches of two kinds
/// add up to at least their reach.
void PairFilter::find_half_reach(std::uint32_t kind) {
  double reach = 0;
  for (std::uint32_t other = 0; other < kind_count; ++other)
    reach = std::max(reach, distances_of(kind, other).reach());
  half_reaches_[kind] = reach / 2;
}

void PairFilter::set_ignored(const Object& a, const Object& b, bool ignored) {
  ++ignored_version_;
  if (!ignored) return ignored_.erase(serials_of(a, b));
  if (ignored_.is_full() && !forgotten_.empty()) {
    drop_forgotten();
    if (4 * ignored_.size() > ignored_.capacity()) ignored_.grow();
  }
  ignored_.insert(serials_of(a, b));
}

/// Defers the removal, since it visits every ignored pair. It happens once enough removed objects have
/// gathered.
void PairFilter::forget(const Object& object) {
  if (!groups_.is_empty()) groups_.forget(object.serial);
  if (ignored_.size() == 0) return;
  forgotten_.push_back(object.serial);
  if (forgotten_.size() > ignored_.capacity()) drop_forgotten();
}

void PairFilter::drop_forgotten() {
  std::sort(forgotten_.begin(), forgotten_.end());
  const auto is_forgotten = [&](std::uint64_t serial) {
    return std::binary_search(forgotten_.begin(), forgotten_.end(), serial);
  };
  ignored_.erase_if(
      [&](const PairSet::Pair& pair) { return is_forgotten(pair.first) || is_forgotten(pair.second); });
  forgotten_.clear();
}

PairVerdict PairFilter::verdict(const ObjectSummary& a, const ObjectSummary& b) const {
  if (a.is_fixed && b.is_fixed) return PairVerdict::fixed;
  if ((a.layer & b.collides_with) == 0 || (b.layer & a.collides_with) == 0) return PairVerdict::layer;
  if (a.group != 0 && a.group == b.group) return PairVerdict::group;
  if (ignored_.size() > 0 && ignored_.contains(std::minmax(a.serial, b.serial))) return PairVerdict::ignored;
  if (!groups_.is_empty() && groups_.ignores_all(std::min(a.serial, b.serial), std::max(a.serial, b.serial)))
    return PairVerdict::ignored;
  return PairVerdict::tested;
}

PairThresholds PairFilter::thresholds(const ObjectSummary& a, const ObjectSummary& b) const {
  const Distances& distances = distances_of(a.kind, b.kind);
  return {distances.contact + (a.margin + b.margin), reach(a, b), distances.epsilon};
}

std::size_t PairFilter::byte_count() const {
  return ignored_.byte_count() + groups_.byte_count() + forgotten_.capacity() * sizeof(std::uint64_t) +
         rules_.capacity() * sizeof(PairRule) + distances_.capacity() * sizeof(Distances) +
         rule_of_.capacity() * sizeof(std::uint16_t);
}

}  // namespace graze
