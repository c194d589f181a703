#include "feature_pairs.hpp"

#include <algorithm>

namespace graze {
namespace {

/// What a query for contacts wants: what is below the threshold, and piercing at every threshold.
struct BelowThreshold {
  double threshold;

  [[nodiscard]] double limit() const { return threshold; }
  [[nodiscard]] bool keep(double lower) const { return lower < threshold || lower == 0; }
  void left_out(double /*limit*/) const {}
};

}  // namespace

void add_close_features(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, double threshold,
                        LeafScratch& scratch, std::vector<ContactName>& names) {
  BelowThreshold range{threshold};
  const auto is_contact = [&](const ContactName& name, const SquaredRange& squared) {
    if (name.meeting == Meeting::pierced && name.kind == ContactKind::EF) return true;
    if (squared.is_below(threshold)) return true;
    return !squared.is_beyond(threshold) && is_closer_than(pair, name, threshold);
  };
  for_each_name(pair, leaf_a, leaf_b, scratch, range,
                [&](const ContactName& name, const SquaredRange& squared) {
                  if (is_contact(name, squared)) names.push_back(name);
                });
}

void keep_nearest_of_each(const SurfacePair& pair, std::vector<ContactName>& names) {
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (kept == 0 || !names[kept - 1].same_features(names[i]))
      names[kept++] = names[i];
    else if (compare_distances(pair, names[i], names[kept - 1]) < 0)
      names[kept - 1] = names[i];
  }
  names.resize(kept);
}

}  // namespace graze
