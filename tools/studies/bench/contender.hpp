#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/scenes/world.hpp"

namespace graze::bench {

/// The question of each frame. Task A asks for all vertex pairs of different objects nearer than the
/// distance. Task B asks for all contacts between surfaces nearer than it. Task D asks for the distance of
/// every pair of objects nearer than it.
enum class Task : char { A = 'A', B = 'B', D = 'D' };

/// Object a comes before object b.
struct VertexPair {
  std::uint32_t object_a, object_b, vertex_a, vertex_b;
  friend auto operator<=>(const VertexPair&, const VertexPair&) = default;
};

struct TrianglePair {
  std::uint32_t object_a, object_b, triangle_a, triangle_b;
  double distance;  ///< 0 where they meet
};

/// A pair of closest features, as graze names them.
struct FeaturePair {
  struct Feature {
    std::uint32_t dimension;  ///< 0 vertex, 1 edge, 2 face
    std::uint32_t index;
  };
  std::uint32_t object_a, object_b;
  Feature feature_a, feature_b;
  double distance;
};

struct ObjectDistance {
  std::uint32_t object_a, object_b;
  double lower, upper;  ///< equal but for rounding
};

/// The results of a frame, in any order, each listed once.
struct Found {
  std::vector<VertexPair> vertex_pairs;      ///< task A
  std::vector<TrianglePair> triangle_pairs;  ///< task B of all but graze
  std::vector<FeaturePair> feature_pairs;    ///< task B of graze
  std::vector<ObjectDistance> distances;     ///< task D

  void clear() {
    vertex_pairs.clear();
    triangle_pairs.clear();
    feature_pairs.clear();
    distances.clear();
  }
};

/// One way to answer a task in every frame. It keeps a reference to the world and reads it in `frame`.
class Contender {
 public:
  Contender() = default;
  virtual ~Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;

  /// Answers for the world as it is now. This is what is timed.
  virtual void frame() = 0;
  /// Adds the last frame's answer. Not timed.
  virtual void collect(Found& found) const = 0;
};

/// How a contender of the module of peers is made.
struct PeerEntry {
  using Make = std::unique_ptr<Contender> (*)(const World& world, Task task, unsigned threads);

  std::string_view name;
  std::string_view tasks;  ///< letters of Task
  Make make;
  /// How closely its distances are told: 0 where they are as good as double allows.
  double precision = 0;
};

/// The limits that no answer can beat: they find nothing.
inline constexpr std::string_view read_limit = "read";
inline constexpr std::string_view box_limit = "box";
/// Reads what moves and what is near it. Only in scenes where most rests.
inline constexpr std::string_view movers_limit = "read movers";

/// Names the contender that gives the pairs of triangles with near boxes, found by `clipping` in task B,
/// without distances. It serves contenders that calculate the distances themselves.
inline constexpr std::string_view clipping_candidates = "clipping's candidates";

constexpr bool is_limit(std::string_view name) {
  return name == read_limit || name == box_limit || name == movers_limit;
}

/// The list of peers, which the module of peers exports under the name `graze_bench_peers`.
using PeerList = std::span<const PeerEntry>;
using ListPeers = void (*)(PeerList& list, std::string_view& compiled_for);

}  // namespace graze::bench
