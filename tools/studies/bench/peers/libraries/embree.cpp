#include <embree3/rtcore.h>

#include <mutex>
#include <string>
#include <vector>

#include "bench/peers/lazy_trees.hpp"
#include "bench/peers/peers.hpp"

namespace graze::bench {
namespace {

/// Embree as a library: one at a time. Its own threads are as many as divide objects and pairs among them,
/// since it limits those of the whole process to the number that it is given.
class Device {
 public:
  explicit Device(unsigned threads)
      : device_(rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str())) {
    in_use_ = device_;
  }
  ~Device() {
    in_use_ = nullptr;
    rtcReleaseDevice(device_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  static RTCDevice in_use() { return in_use_; }

 private:
  static inline RTCDevice in_use_ = nullptr;
  RTCDevice device_;
};

/// Embree: a scene for each object with one user geometry, a primitive for each vertex or triangle, refitted.
/// Pairs of scenes go by rtcCollide.
class EmbreeTree {
 public:
  EmbreeTree(const World& world, Task task, std::uint32_t object)
      : parts_(world, task, object), scene_(rtcNewScene(Device::in_use())) {
    geometry_ = rtcNewGeometry(Device::in_use(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
    rtcSetGeometryUserPrimitiveCount(geometry_, parts_.count());
    rtcSetGeometryUserData(geometry_, &parts_);
    rtcSetGeometryBoundsFunction(geometry_, write_bounds, nullptr);
    rtcCommitGeometry(geometry_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_,
                            RTC_BUILD_QUALITY_LOW);  // a tree for each geometry: the kind that is refitted
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }
  ~EmbreeTree() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
  }
  EmbreeTree(const EmbreeTree&) = delete;
  EmbreeTree& operator=(const EmbreeTree&) = delete;

  void update() {
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  void match(EmbreeTree& other, Found& found) {
    Match match;
    rtcCollide(scene_, other.scene_, take, &match);
    for (const RTCCollision& each : match.collisions)
      parts_.test(each.primID0, other.parts_, each.primID1, found);
  }

 private:
  /// Collisions that Embree reports, from several threads but from one at a time.
  struct Match {
    std::vector<RTCCollision> collisions;
    std::mutex telling;
  };

  static void write_bounds(const RTCBoundsFunctionArguments* arguments) {
    const FloatBox box = static_cast<const Parts*>(arguments->geometryUserPtr)->grown_box(arguments->primID);
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = box.min[0];
    bounds.lower_y = box.min[1];
    bounds.lower_z = box.min[2];
    bounds.upper_x = box.max[0];
    bounds.upper_y = box.max[1];
    bounds.upper_z = box.max[2];
  }
  static void take(void* user, RTCCollision* collisions, unsigned count) {
    Match& match = *static_cast<Match*>(user);
    const std::lock_guard lock(match.telling);
    match.collisions.insert(match.collisions.end(), collisions, collisions + count);
  }

  Parts parts_;
  RTCScene scene_;
  RTCGeometry geometry_ = nullptr;
};

class Embree final : public Contender {
 public:
  Embree(const World& world, Task task, unsigned threads) : device_(threads), trees_(world, task, threads) {}

  void frame() override { trees_.frame(); }
  void collect(Found& found) const override { trees_.collect(found); }

 private:
  Device device_;
  LazyTrees<EmbreeTree> trees_;
};

}  // namespace

std::unique_ptr<Contender> make_embree(const World& world, Task task, unsigned threads) {
  return std::make_unique<Embree>(world, task, threads);
}

}  // namespace graze::bench
