#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <graze/graze.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "scenes/random.hpp"

namespace graze::tools {

/// A scene that is treated badly, and a model of what was said to it. Two writers and the stepping thread own
/// bodies of their own: they add and remove, move and teleport them, and make every mistake that there is a
/// diagnostic for. The stepping thread's bodies are bound memory.
class SoakWorld {
 public:
  static constexpr std::size_t writer_count = 2;

  explicit SoakWorld(std::uint64_t seed);

  /// Makes the scene anew with other settings, everything where it is. Nothing else may run.
  void remake_scene();
  [[nodiscard]] Scene& scene() { return *scene_; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] std::string mode() const;

  /// Some calls of one writer: on a thread of its own, while a step runs.
  void write(std::size_t writer);
  /// Moves bound memory, changes pairs and rules: the stepping thread, between steps, while nobody writes.
  /// Without mistakes every position is good afterwards.
  void change_between_steps(bool with_mistakes);
  /// Describes how the report of a step differs from that of a scene built afresh. Empty if it does not. No
  /// writer may have made calls during that step.
  [[nodiscard]] std::string difference_from_fresh(const FrameReport& report) const;

 private:
  enum class Given { copied, posed, bound };
  struct Body {
    ObjectId id;
    std::uint64_t serial = 0;  ///< in the order in which they were added
    ObjectSettings settings;
    Given given = Given::copied;
    BindPolicy policy = BindPolicy::every_step;
    std::shared_ptr<const Mesh> mesh;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::vector<Eigen::Vector3d> positions;  ///< bound ones are read from here
    bool is_spoiled = false;                 ///< holds a NaN until the next change
    bool is_new = true;                      ///< no step has seen it
  };
  /// The state that belongs to one thread.
  struct Owner {
    explicit Owner(std::uint64_t seed) : random(seed) {}
    scenes::Random random;
    std::vector<std::unique_ptr<Body>> bodies;
    ObjectId gone;
  };

  void add_to_scene(Body& body);
  void add(Owner& owner, Given given);
  void remove_any(Owner& owner);
  static Body& any(Owner& owner);
  void come_and_go(Owner& owner, bool is_bound);
  void make_mistake(Owner& owner);
  static void teleport(scenes::Random& random, Body& body);
  void place(Body& body);
  void move_bound(Body& body, bool with_mistakes);
  void change_pairs();
  void change_rules();
  /// By serial.
  [[nodiscard]] std::vector<Body*> all_bodies() const;
  /// Says which place each object has in the order in which they were added.
  ReportHandle built_afresh(std::map<ObjectId, std::size_t>& places) const;

  std::vector<std::shared_ptr<const Mesh>> meshes_;
  SceneSettings settings_;
  std::size_t mode_ = 0;
  std::unique_ptr<Scene> scene_;
  std::mutex adding_;  ///< so that the order in which objects were added is known
  std::uint64_t next_serial_ = 0;
  std::array<Owner, writer_count + 1> owners_;                    ///< the last is the stepping thread
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ignored_;  ///< by serial
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRule> rules_;
};

}  // namespace graze::tools
