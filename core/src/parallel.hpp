#pragma once

#include <Eigen/Core>
#include <graze/contact.hpp>
#include <graze/pair_query.hpp>
#include <utility>
#include <vector>

#include "contact_name.hpp"
#include "reserve_as.hpp"

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

  void reserve_as(const ParallelScratch& other) {
    graze::reserve_as(holders_a, other.holders_a);
    graze::reserve_as(holders_b, other.holders_b);
    graze::reserve_as(holders, other.holders);
    graze::reserve_as(candidates, other.candidates);
    graze::reserve_as(found, other.found);
  }
  void reserve(const PairRoom& room) {
    holders_a.reserve(room.ties);
    holders_b.reserve(room.ties);
    holders.reserve(room.ties);
    candidates.reserve(room.ties);
    found.reserve(room.ties);
  }
  [[nodiscard]] std::size_t byte_count() const {
    return bytes_of(holders_a) + bytes_of(holders_b) + bytes_of(holders) + bytes_of(candidates) +
           bytes_of(found);
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
