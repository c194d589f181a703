#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "core/base/bytes_of.hpp"
#include "core/pair/group_filter.hpp"
#include "core/sweep/pair_sweep.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

/// The features of one leaf that meet a moving box on the way, with their own boxes.
struct MovingFeatures {
  struct Feature {
    MovingBox box;
    std::uint32_t index;
  };
  std::vector<Feature> vertices;
  std::vector<Feature> edges;
  std::vector<Feature> faces;

  /// The boxes of the features are grown by `gap`.
  void collect(const MovingSurface& surface, const Region& leaf, const MovingBox& near, double gap);

  /// Makes room for the features of the largest leaf.
  void reserve(const PairRoom& room);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.vertices, self.edges, self.faces);
  }
};

/// Tests the features of two leaves, and lists what meets. It refers to what it is made of.
class LeafSweep {
 public:
  LeafSweep(const MovingSurface& a, const MovingSurface& b, const SweepQuery& query, SweepAnswer& answer,
            SweepWork& work)
      : a_(a), b_(b), query_(query), answer_(answer), work_(work) {}

  /// Tests each vertex and face, and each two edges, of the leaves of two regions. `same` says that both are
  /// one leaf of one surface.
  void test(const MovingFeatures& of_a, const MovingFeatures& of_b, bool same);

 private:
  template <typename Test>
  void test_all(const std::vector<MovingFeatures::Feature>& of_a,
                const std::vector<MovingFeatures::Feature>& of_b, const Test& test);
  [[nodiscard]] bool may(const FeatureRef& of_a, const FeatureRef& of_b) const {
    return query_.groups == nullptr || query_.groups->may(of_a, of_b);
  }
  void test_vertex_face(std::uint32_t vertex, std::uint32_t face, bool is_vertex_of_a);
  void test_edges(std::uint32_t edge_a, std::uint32_t edge_b);
  void note_gap(const std::optional<double>& time);
  void list(const Impact& impact);

  const MovingSurface& a_;
  const MovingSurface& b_;
  const SweepQuery& query_;
  SweepAnswer& answer_;
  SweepWork& work_;
};

}  // namespace graze
