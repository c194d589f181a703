#include "pair_filter.hpp"

#include <algorithm>

namespace graze {
namespace {

/// DV's threshold: the last of the paper's numbers where there are any.
double base_distance(double contact_distance, std::span<const double> epsilon) {
  return epsilon.empty() ? contact_distance : epsilon.back();
}

}  // namespace

void PairFilter::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, PairRule rule) {
  rules_.insert_or_assign(key_of(kind_a, kind_b), std::move(rule));
  ++rules_version_;
}

void PairFilter::set_ignored(const Object& a, const Object& b, bool ignored) {
  if (ignored)
    ignored_.insert(key_of(a.serial, b.serial));
  else
    ignored_.erase(key_of(a.serial, b.serial));
}

void PairFilter::forget(const Object& object) {
  std::erase_if(ignored_,
                [&](const Key& key) { return key.first == object.serial || key.second == object.serial; });
}

bool PairFilter::allows(const Object& a, const Object& b) const {
  if (a.settings.motion == Motion::fixed && b.settings.motion == Motion::fixed) return false;
  if ((a.settings.layer & b.settings.collides_with) == 0 ||
      (b.settings.layer & a.settings.collides_with) == 0)
    return false;
  return ignored_.empty() || !ignored_.contains(key_of(a.serial, b.serial));
}

std::span<const double> PairFilter::epsilon_of(const PairRule& rule) const {
  if (settings_.accuracy.mode() != AccuracyMode::paper) return {};
  return rule.epsilon.empty() ? settings_.accuracy.epsilon() : rule.epsilon;
}

PairThresholds PairFilter::thresholds(const Object& a, const Object& b) const {
  const auto rule = rules_.find(key_of(a.settings.kind, b.settings.kind));
  const bool has_rule = rule != rules_.end();
  PairThresholds result;
  result.epsilon =
      has_rule ? epsilon_of(rule->second) : std::span<const double>(settings_.accuracy.epsilon());
  const double contact_distance = has_rule ? rule->second.contact_distance : settings_.contact_distance;
  result.threshold =
      base_distance(contact_distance, result.epsilon) + (a.settings.margin + b.settings.margin);
  result.reach = std::max(has_rule ? rule->second.range : settings_.range, result.threshold);
  return result;
}

double PairFilter::largest_reach() const {
  double reach =
      std::max(settings_.range, base_distance(settings_.contact_distance, settings_.accuracy.epsilon()));
  for (const auto& [kinds, rule] : rules_)
    reach = std::max({reach, rule.range, base_distance(rule.contact_distance, epsilon_of(rule))});
  return reach;
}

}  // namespace graze
