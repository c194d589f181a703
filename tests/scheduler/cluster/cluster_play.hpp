#pragma once

#include <graze/cluster/scene.hpp>
#include <graze/graze.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/random.hpp"
#include "scheduler/scene_support.hpp"

namespace graze::tests {

/// A call on a scene, by the numbers of objects.
struct ClusterCall {
  enum class Kind : std::uint8_t {
    add,
    replace,
    remove,
    pose,
    positions,
    bind,
    write,  ///< new content of bound memory
    unbind,
    ignore,
    watch,
    ignore_groups,
    watch_groups,
    rule,
  };
  Kind kind = Kind::pose;
  std::uint32_t number = 0;
  std::uint32_t other = 0;
  std::shared_ptr<const Mesh> mesh = {};
  ObjectSettings settings = {};
  std::vector<std::uint32_t> new_of_old = {};
  std::vector<std::uint8_t> face_groups = {};
  std::array<double, 12> pose = {};
  Positions positions = {};
  bool jumps = false;
  std::uint8_t group = 0;
  std::uint8_t other_group = 0;
  PairRule rule = {};
};

/// Says how many objects and frames a play has, and of which kinds.
struct PlaySettings {
  SceneSettings scene;
  std::uint64_t seed = 1;
  std::size_t objects = 16;
  std::size_t frames = 20;
  double size = 8;  ///< of the cube in which objects move
  bool swept = false;
  bool self = false;
  bool solids = false;
  bool is_long = false;  ///< each frame is kept as one number
  bool late = false;     ///< ranks are slow at times, and so are their messages
};

/// The calls of each frame, drawn at random: objects that wander about, come, go, freeze, get other meshes,
/// and are taken out of each other.
[[nodiscard]] std::vector<std::vector<ClusterCall>> calls_of(const PlaySettings& settings);

/// The rows and diagnostics of each frame as text, by the ids of a cluster, as one scene has them.
[[nodiscard]] std::vector<std::vector<std::string>> played_by_one(
    const PlaySettings& settings, std::span<const std::vector<ClusterCall>> frames);

/// A transport that hands all to another one.
class ForwardingTransport : public cluster::Transport {
 public:
  explicit ForwardingTransport(std::shared_ptr<Transport> transport) : transport_(std::move(transport)) {}

  [[nodiscard]] int rank() const final { return transport_->rank(); }
  [[nodiscard]] int size() const final { return transport_->size(); }
  [[nodiscard]] std::vector<Bytes> all_gather(std::span<const std::byte> given) override {
    return transport_->all_gather(given);
  }
  [[nodiscard]] std::vector<Bytes> gather(std::span<const std::byte> given) override {
    return transport_->gather(given);
  }
  void sum(std::span<std::uint64_t> numbers) override { transport_->sum(numbers); }
  [[nodiscard]] std::vector<Bytes> exchange(std::span<const int> ranks,
                                            std::span<const Bytes> messages) override {
    return transport_->exchange(ranks, messages);
  }
  void fail(const std::string& why) noexcept final { transport_->fail(why); }

 private:
  std::shared_ptr<Transport> transport_;
};

/// A rank that takes part in a play.
class PlayingRank {
 public:
  PlayingRank(const PlaySettings& settings, std::shared_ptr<cluster::Transport> transport,
              const cluster::ClusterSettings& cluster = {})
      : scene(settings.scene, std::move(transport), cluster) {}
  /// Makes all calls of a frame. An object belongs first to the rank that its place at the beginning gives
  /// it.
  void take(const std::vector<ClusterCall>& calls);

  cluster::Scene scene;

 private:
  std::map<std::uint32_t, Positions> memory_;
};

/// The rank that adds an object.
[[nodiscard]] int first_rank_of(std::uint32_t number, int ranks);

/// The rows of a report as text, and its diagnostics.
[[nodiscard]] std::vector<std::string> texts_of(const FrameReport& report);

/// The texts of all reports of a cluster.
struct Played {
  std::vector<std::vector<std::string>> gathered;              ///< by frame
  std::vector<std::vector<std::vector<std::string>>> by_rank;  ///< by rank and frame
  cluster::ClusterStatistics sum;                              ///< of all ranks and frames
  std::string problem;                                         ///< of a rank that threw
};
[[nodiscard]] Played played_by_cluster(const PlaySettings& settings,
                                       std::span<const std::vector<ClusterCall>> frames, int ranks,
                                       const cluster::ClusterSettings& cluster = {});

}  // namespace graze::tests
