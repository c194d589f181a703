#pragma once

#include <vector>

#include "contact_name.hpp"
#include "leaf_names.hpp"

namespace graze {

/// Finds the names of `ContactDetail::features` between leaves of two surfaces: all contacts strictly closer
/// than a threshold and every edge that pierces a face. A name may be met in several pairs of leaves.
class CloseFeatures {
 public:
  /// Names are appended to `names`; all are there after `finish`.
  CloseFeatures(const SurfacePair& pair, double threshold, LeafScratch& scratch,
                std::vector<ContactName>& names)
      : pair_(pair), threshold_(threshold), scratch_(scratch), names_(names) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  /// The features that the scratch has taken, whatever they are of.
  void add_taken();
  void finish();

 private:
  template <typename Use>
  void with_names(const Use& use);
  [[nodiscard]] bool is_contact(const ContactName& name, const SquaredRange& squared) const;
  void take(const ContactName& name, const SquaredRange& squared);

  const SurfacePair& pair_;
  double threshold_;
  LeafScratch& scratch_;
  std::vector<ContactName>& names_;
};

/// Keeps one of sorted names for each pair of features. Where two features meet in several pieces (a fold and
/// a triangle, two crossings), the nearest stands for them; a piercing sorts first, and of equally near ones
/// the first.
void keep_nearest_of_each(const SurfacePair& pair, std::vector<ContactName>& names);

}  // namespace graze
