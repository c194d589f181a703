#pragma once

#include <span>
#include <vector>

#include "core/pair/near_list.hpp"
#include "leaves/leaf_names.hpp"
#include "names/contact_name.hpp"
#include "pair/near_listing.hpp"

namespace graze {

/// Finds the names of `ContactDetail::features` between leaves of two surfaces: all contacts strictly closer
/// than a threshold and every edge that pierces a face. A name may be met in several pairs of leaves.
class CloseFeatures {
 public:
  /// Names are appended to `names`; all are there after `finish`.
  CloseFeatures(const SurfacePair& pair, double threshold, LeafScratch& scratch,
                std::vector<ContactName>& names, const NearListing& listing = {})
      : pair_(pair), threshold_(threshold), scratch_(scratch), names_(names), listing_(listing) {}

  void add(const LeafOf& leaf_a, const LeafOf& leaf_b);
  /// For what is added from here on, after `finish`.
  void set_threshold(double threshold) { threshold_ = threshold; }
  /// The features that the scratch has taken, whatever they are of.
  void add_taken();
  /// Features that were listed, in the frame of the scratch.
  void add_listed(std::span<const NearParts> listed);
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
  NearListing listing_;
};

/// Keeps one of sorted names for each pair of features. Where two features meet in several pieces (a fold and
/// a triangle, two crossings), the nearest stands for them; a piercing sorts first, and of equally near ones
/// the first. Returns how many there are then, the first of the names.
[[nodiscard]] std::size_t keep_nearest_of_each(const SurfacePair& pair, std::span<ContactName> names);

}  // namespace graze
