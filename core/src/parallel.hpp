#pragma once

#include <Eigen/Core>
#include <graze/contact.hpp>
#include <graze/pair_query.hpp>
#include <utility>
#include <vector>

#include "contact_name.hpp"
#include "working_memory.hpp"

namespace graze {

/// Two features, of a and b.
using FeaturePair = std::pair<Feature, Feature>;

/// A parallel pair of features and the middle of its closest set.
struct ParallelContact {
  ContactName name;
  Eigen::Vector3d middle_a;
  Eigen::Vector3d middle_b;
};

/// Working memory of one thread.
struct ParallelScratch {
  std::vector<Feature> holders_a, holders_b;
  std::vector<FeaturePair> holders;
  std::vector<FeaturePair> candidates;
  std::vector<ParallelContact> found;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.holders_a, self.holders_b, self.holders, self.candidates, self.found);
  }
  void reserve(const PairRoom& room) {
    std::apply([&](auto&... part) { (part.reserve(room.ties), ...); }, parts(*this));
  }
};

/// `ContactDetail::closest` of two surfaces from all names at their least distance (sorted, at least one).
///
/// Features that are parallel to each other have a stretch or an area of closest points; where one holds a
/// name's features it stands for that name, since those points are only its border: the area between a box
/// and the table under it (FF) and not one corner of it (VF). Of what then is left the lowest (kind, feature
/// a, feature b) is the contact, with the middle of its closest set.
Contact closest_contact(const SurfacePair& pair, const std::vector<ContactName>& names,
                        ParallelScratch& scratch);

}  // namespace graze
