#pragma once

#include <graze/graze.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {

/// A scene in which everything moves at random. Objects rest, tremble, drift, shoot through others, jump,
/// collapse to a point and come back, or turn inside out. Objects are added and removed, pairs ignored and
/// watched, rules changed. Positions are given in every way there is, with promises and without. All promises
/// are kept.
class RandomMotion {
 public:
  RandomMotion(std::uint64_t seed, const SceneSettings& settings);

  /// Moves everything and steps.
  ReportHandle step();
  /// The first report of a scene made afresh with everything where it is now. Object i is `ids()[i]`.
  [[nodiscard]] ReportHandle built_afresh() const;
  /// The objects of now in the order in which they were added.
  [[nodiscard]] std::vector<ObjectId> ids() const;
  /// Returns the faces of an object with its vertices where they are now.
  [[nodiscard]] oracle::Shape shape(ObjectId object) const;

 private:
  enum class Given { copied, bound, bound_when_told, posed };
  struct Body {
    ObjectId id;
    ObjectSettings settings;
    Given given = Given::copied;
    std::shared_ptr<const Mesh> mesh;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    double size = 1;         ///< 0: collapsed to a point, -1: inside out
    std::uint32_t rest = 0;  ///< frames still to stand still
    Positions positions;     ///< bound ones are read from here
    Positions seen;          ///< by the last step
  };

  Eigen::Vector3d vector(double size);
  void add_body();
  void remove_body();
  void change_pairs();
  void move(Body& body);
  void change_motion(Body& body);
  void tremble(Body& body);
  void place(Body& body, Positions positions);

  oracle::Random random_;
  SceneSettings settings_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  Scene scene_;
  std::vector<Body> bodies_;
  bool is_on_grid_;  ///< most positions are, where distances tie and features are parallel
  std::vector<std::pair<ObjectId, ObjectId>> ignored_;
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, PairRule>> rules_;
};

}  // namespace graze::tests
