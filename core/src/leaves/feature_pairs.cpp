#include "leaves/feature_pairs.hpp"

namespace graze {
namespace {

/// What a query for contacts wants: what is below the threshold, and piercing at every threshold; and to be
/// listed what comes to be so within a slack.
struct BelowThreshold {
  double threshold;
  const NearListing& listing;

  [[nodiscard]] double limit() const { return threshold + listing.slack; }
  [[nodiscard]] double names_below() const { return threshold; }
  [[nodiscard]] static bool may_pierce() { return true; }
  [[nodiscard]] double touching() const { return listing.slack; }
  [[nodiscard]] bool is_listing() const { return listing.is_wanted(); }
  void found(const PartOf& a, const PartOf& b) const { listing.add(a, b); }
  [[nodiscard]] bool keep(double lower) const { return lower < limit() || lower == 0; }
  void left_out(double /*limit*/) const {}
};

}  // namespace

bool CloseFeatures::is_contact(const ContactName& name, const SquaredRange& squared) const {
  if (name.meeting() == Meeting::pierced && name.kind() == ContactKind::EF) return true;
  if (squared.is_below(threshold_)) return true;
  return !squared.is_beyond(threshold_) && is_closer_than(pair_, name, threshold_);
}

void CloseFeatures::take(const ContactName& name, const SquaredRange& squared) {
  pair_.check_time();
  if (!is_contact(name, squared)) return;
  std::uint32_t& place = scratch_.recent_names.place(name);
  if (place < names_.size() && names_[place] == name) return;
  place = static_cast<std::uint32_t>(names_.size());
  names_.push_back(name);
}

void CloseFeatures::add(const LeafOf& leaf_a, const LeafOf& leaf_b) {
  BelowThreshold range{threshold_, listing_};
  if (scratch_.take(pair_, leaf_a, leaf_b, range)) add_taken();
}

void CloseFeatures::add_taken() {
  with_names([](auto& names) { names.add_taken(); });
}

void CloseFeatures::add_listed(std::span<const NearParts> listed) {
  with_names([&](auto& names) { names.add_listed(listed); });
}

void CloseFeatures::finish() {
  with_names([](auto& names) { names.finish(); });
}

/// Calls `use` with what gives the names to `take`.
template <typename Use>
void CloseFeatures::with_names(const Use& use) {
  BelowThreshold range{threshold_, listing_};
  const auto sink = [&](const ContactName& name, const SquaredRange& squared) { take(name, squared); };
  LeafNames names(pair_, scratch_, range, sink);
  use(names);
}

std::size_t keep_nearest_of_each(const SurfacePair& pair, std::span<ContactName> names) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    pair.check_time();
    if (kept == 0 || !names[kept - 1].same_features(names[i]))
      names[kept++] = names[i];
    else if (names[i] != names[i - 1] && compare_distances(pair, names[i], names[kept - 1]) < 0)
      names[kept - 1] = names[i];
  }
  return kept;
}

}  // namespace graze
