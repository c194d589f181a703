#pragma once

#include <functional>

#include "scheduler/scene_support.hpp"

namespace graze::tests {

/// A dozen small objects, models and random shapes, that turn, bend and pass through each other. Positions
/// are given in every way there is: copied, bound as floats, and as poses.
class MovingScene {
 public:
  /// Which object comes first, and so on: an object's place says nothing of what it does.
  using Order = std::vector<std::size_t>;

  MovingScene();

  [[nodiscard]] std::size_t object_count() const { return bodies_.size(); }
  [[nodiscard]] Order given_order() const;

  /// Steps through frames 0 to count - 1. Calls `look` with each report and the ids in the bodies' order.
  using Look = std::function<void(std::size_t frame, const ReportHandle&, const std::vector<ObjectId>&)>;
  void play(const SceneSettings& settings, std::size_t count, const Look& look,
            const std::shared_ptr<TaskScheduler>& scheduler = nullptr) const;
  std::vector<ReportHandle> play(const SceneSettings& settings, std::size_t count,
                                 const std::shared_ptr<TaskScheduler>& scheduler = nullptr) const;

  /// The first step of a scene made in the given order with everything where it is in `frame`.
  ReportHandle built_afresh(const SceneSettings& settings, std::size_t frame) const {
    return built_afresh(settings, frame, given_order());
  }
  ReportHandle built_afresh(const SceneSettings& settings, std::size_t frame, const Order& order) const;

 private:
  enum class Given { copied, bound, posed };
  struct Body {
    std::shared_ptr<const Mesh> mesh;
    Given given = Given::copied;
    Eigen::Vector3d centre, path, axis;
    double speed = 0;
    double bend = 0;
  };

  [[nodiscard]] Eigen::Isometry3d pose(const Body& body, std::size_t frame) const;
  [[nodiscard]] std::vector<Eigen::Vector3f> positions(const Body& body, std::size_t frame) const;
  void place(Scene& scene, const Body& body, ObjectId id, std::size_t frame) const;

  std::vector<Body> bodies_;
};

}  // namespace graze::tests
