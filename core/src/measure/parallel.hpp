#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/contact.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Two features, of a and b.
using TwoFeatures = std::pair<Feature, Feature>;

/// An edge or face that holds a feature. Its direction shows of most that they are not parallel to others. An
/// edge has its own direction, a face the normal of a triangle. The fourth number is the square of its
/// length, were the corners square.
struct Holder {
  std::uint32_t feature;
  std::array<double, 4> direction;
};

/// All that hold a feature, itself included where it is no vertex. A quad comes for each of its triangles.
struct Holders {
  std::vector<Holder> edges;
  std::vector<Holder> faces;

  void find(const Surface& surface, const Feature& feature);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.edges, self.faces);
  }
  void reserve(const PairRoom& room);

 private:
  void add_edge(const Surface& surface, std::uint32_t edge);
  void add_face(const Surface& surface, std::uint32_t face);
};

/// Working memory of one thread.
struct ParallelScratch {
  /// Whether two faces are parallel contacts, of those that were asked about last.
  struct Known {
    TwoFeatures faces;
    std::uint32_t query = 0;  ///< the number of the query that asked
    bool are_parallel = false;
  };

  Holders of_key_a, of_key_b;
  Holders above_a, above_b;
  std::vector<Known> known;
  std::uint32_t query = 0;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.of_key_a, self.of_key_b, self.above_a, self.above_b, self.known);
  }
  void reserve(const PairRoom& room);
};

/// `ContactDetail::closest` of two surfaces from all keys at their least distance (sorted, at least one).
///
/// Features that are parallel to each other have a stretch or an area of closest points. Where one of these
/// holds a key's features it stands for that key, since those points are only its border. An example is the
/// area between a box and the table under it (FF), and not one corner of it (VF). The lowest (kind, feature
/// a, feature b) of the rest is the contact, with the middle of its closest set.
Contact closest_contact(const SurfacePair& pair, const std::vector<FeaturePairKey>& keys,
                        ParallelScratch& scratch);

}  // namespace graze
