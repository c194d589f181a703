#include "feature_pairs.hpp"

#include <array>

namespace graze {
namespace {

/// What a query for contacts wants: what is below the threshold, and piercing at every threshold.
struct BelowThreshold {
  double threshold;

  [[nodiscard]] double limit() const { return threshold; }
  [[nodiscard]] bool keep(double lower) const { return lower < threshold || lower == 0; }
  void left_out(double /*limit*/) const {}
};

/// Adds names, and most of those that were added a moment ago only once: a contact is found from each of the
/// features about it, so that what is left to sort is a fraction.
class NameAdder {
 public:
  explicit NameAdder(std::vector<ContactName>& names) : names_(names) {}

  void add(const ContactName& name) {
    // Any place will do to look at, so that none needs to be marked as free.
    std::uint32_t& place = places_[name.hash() >> 56U];
    if (place < names_.size() && names_[place] == name) return;
    place = static_cast<std::uint32_t>(names_.size());
    names_.push_back(name);
  }

 private:
  std::vector<ContactName>& names_;
  std::array<std::uint32_t, 256> places_{};
};

}  // namespace

void add_close_features(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, double threshold,
                        LeafScratch& scratch, std::vector<ContactName>& names) {
  BelowThreshold range{threshold};
  if (scratch.take(pair, leaf_a, leaf_b, range)) add_close_features(pair, threshold, scratch, names);
}

void add_close_features(const SurfacePair& pair, double threshold, LeafScratch& scratch,
                        std::vector<ContactName>& names) {
  BelowThreshold range{threshold};
  const auto is_contact = [&](const ContactName& name, const SquaredRange& squared) {
    if (name.meeting == Meeting::pierced && name.kind == ContactKind::EF) return true;
    if (squared.is_below(threshold)) return true;
    return !squared.is_beyond(threshold) && is_closer_than(pair, name, threshold);
  };
  NameAdder adder(names);
  for_each_name_of_taken(pair, scratch, range, [&](const ContactName& name, const SquaredRange& squared) {
    if (is_contact(name, squared)) adder.add(name);
  });
}

void keep_nearest_of_each(const SurfacePair& pair, std::vector<ContactName>& names) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (kept == 0 || !names[kept - 1].same_features(names[i]))
      names[kept++] = names[i];
    else if (names[i] != names[i - 1] && compare_distances(pair, names[i], names[kept - 1]) < 0)
      names[kept - 1] = names[i];
  }
  names.resize(kept);
}

}  // namespace graze
