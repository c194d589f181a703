#pragma once

#include <array>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scheduler/scene_support.hpp"

namespace graze::tests {

/// A plate over which drops bob up and down, each one frame later than the one before: in every frame one
/// comes to touch the plate and one leaves it. They are moved in every way there is, by single calls and in
/// batches, and every pair is filtered out now and then. All that is told was calculated before.
class Bobbing {
 public:
  /// In frames, as many as there are drops.
  static constexpr std::size_t period = 20;

  explicit Bobbing(const SceneSettings& settings);

  [[nodiscard]] Scene& scene() { return scene_; }
  /// Says all that changes in a frame.
  void tell(std::size_t frame);
  ReportHandle step(std::size_t frame) {
    tell(frame);
    return scene_.step();
  }

 private:
  enum class Given { copied, bound, told, posed };
  static Given given_of(std::size_t drop) { return static_cast<Given>(drop % 4); }
  [[nodiscard]] const std::vector<std::size_t>& all(Given given) const {
    return of_[static_cast<std::size_t>(given)];
  }

  /// The arguments of one batch call for the drops that are given in one way. The first of these drops is
  /// left out: it gets a call of its own.
  struct Batch {
    std::array<ObjectId, period> ids;
    std::array<PositionView, period> views;
    std::array<double, period> promises;
    std::array<Eigen::Isometry3d, period> poses;
    std::size_t size = 0;
  };
  [[nodiscard]] Batch batch_of(Given given, std::size_t frame) const;

  void copy(std::size_t frame);
  void bind(std::size_t frame);
  void write(std::size_t frame);
  void place(std::size_t frame);

  Scene scene_;
  std::shared_ptr<const Mesh> mesh_;
  ObjectId plate_;
  std::array<ObjectId, period> ids_;
  std::array<std::vector<std::size_t>, 4> of_;  ///< the drops given in each way
  std::array<std::vector<Eigen::Isometry3d>, period> poses_;
  std::array<std::vector<Positions>, period> positions_;
  std::vector<Positions> own_;  ///< bound, and read when told
};

/// A small sphere.
std::shared_ptr<const Mesh> drop_mesh();

}  // namespace graze::tests
